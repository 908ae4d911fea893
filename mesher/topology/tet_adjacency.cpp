#include "mesher/topology/tet_adjacency.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <span>

#include "mesher/core/error.hpp"
#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

/// Counts in first[i + 1] become the places where the rows begin.
void sum_up(std::vector<std::uint32_t>& first) {
  for (std::size_t i = 1; i < first.size(); ++i) {
    first[i] += first[i - 1];
  }
}

/// Finds the other sides of faces. The tets are cut in blocks and the vertices in ranges; the faces of a
/// block go to the range of their smallest vertex, and those of a range meet in a small hash table. All of it
/// is parallel, and which of two tets comes first makes no difference.
class FaceMatcher {
 public:
  FaceMatcher(const TetNodes& tets, std::size_t vertex_count, TetNeighbours& neighbours)
      : tets_(tets),
        shift_(shift_for(vertex_count)),
        neighbours_(neighbours),
        blocks_(std::clamp<std::size_t>(tets.size() / kTetsOfBlock, 1, kMostPieces)),
        ranges_((vertex_count >> shift_) + 1),
        open_(std::make_unique_for_overwrite<TetId[]>(tets.size())),
        open_count_(blocks_),
        next_(blocks_ * ranges_, 0) {}

  /// False when a face belongs to more than two tets.
  bool run() {
    for_blocks([this](std::size_t block) { count(block); });
    number_places();
    faces_ = std::make_unique_for_overwrite<Face[]>(first_.back());
    for_blocks([this](std::size_t block) { place(block); });
    return match();
  }

 private:
  struct Face {
    VertexId least, second, third;
    std::uint32_t tet_and_node;  // 4 * tet + node opposite to the face
  };
  static constexpr std::size_t kTetsOfBlock = 4096, kMostPieces = 256;
  static constexpr unsigned kLeastShift = 9;
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  template <typename F>
  void for_blocks(const F& f) const {
#pragma omp parallel for schedule(dynamic, 1) if (blocks_ > 1)
    for (std::size_t block = 0; block < blocks_; ++block) {
      f(block);
    }
  }

  static unsigned shift_for(std::size_t vertex_count) {
    unsigned shift = kLeastShift;
    while (vertex_count >> shift >= kMostPieces) {
      ++shift;
    }
    return shift;
  }

  [[nodiscard]] std::size_t begin_of(std::size_t block) const {
    return block * tets_.size() / blocks_;
  }

  /// The nodes of a tet in order, each with its place in the tet as its last two bits.
  static std::array<std::uint64_t, 4> sorted_nodes(const std::array<VertexId, 4>& tet) {
    std::array<std::uint64_t, 4> s;
    for (std::uint64_t n = 0; n < 4; ++n) {
      s[n] = std::uint64_t{tet[n]} << 2U | n;
    }
    const auto order = [&s](std::size_t low, std::size_t high) {
      const std::uint64_t least = std::min(s[low], s[high]);
      s[high] = std::max(s[low], s[high]);
      s[low] = least;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    return s;
  }

  /// Calls f(face) for the faces of a tet whose neighbours are unknown.
  template <typename F>
  void for_each_face(TetId t, const F& f) const {
    // The face opposite to each of the sorted nodes, by the places of its nodes there.
    constexpr std::array<std::array<std::uint8_t, 3>, 4> kOthers = {
        {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
    const std::array<std::uint64_t, 4> sorted = sorted_nodes(tets_[t]);
    const auto vertex = [&](std::size_t at) { return static_cast<VertexId>(sorted[at] >> 2U); };
    for (std::size_t at = 0; at < 4; ++at) {
      const auto n = static_cast<std::uint32_t>(sorted[at] & 3U);
      if (neighbours_[t][n] == kUnknownTet) {
        f(Face{vertex(kOthers[at][0]), vertex(kOthers[at][1]), vertex(kOthers[at][2]), 4 * t + n});
      }
    }
  }

  [[nodiscard]] std::size_t range_of(const Face& face) const {
    return face.least >> shift_;
  }

  /// Finds the block's tets with an unknown neighbour, in a late round of a refinement few of all, and counts
  /// their faces.
  void count(std::size_t block) {
    std::uint32_t* const counts = next_.data() + block * ranges_;
    TetId* next = open_.get() + begin_of(block);
    for (auto t = static_cast<TetId>(begin_of(block)); t < begin_of(block + 1); ++t) {
      const auto& across = neighbours_[t];
      if (std::find(across.begin(), across.end(), kUnknownTet) != across.end()) {
        *next++ = t;
        for_each_face(t, [&](const Face& face) { ++counts[range_of(face)]; });
      }
    }
    open_count_[block] = static_cast<std::size_t>(next - open_.get()) - begin_of(block);
  }

  void number_places() {
    first_.assign(ranges_ + 1, 0);
    std::uint32_t place = 0;
    for (std::size_t range = 0; range < ranges_; ++range) {
      for (std::size_t block = 0; block < blocks_; ++block) {
        const std::uint32_t faces = next_[block * ranges_ + range];
        next_[block * ranges_ + range] = place;
        place += faces;
      }
      first_[range + 1] = place;
    }
  }

  void place(std::size_t block) {
    std::uint32_t* const next = next_.data() + block * ranges_;
    const TetId* const open = open_.get() + begin_of(block);
    for (const TetId t : std::span(open, open_count_[block])) {
      for_each_face(t, [&](const Face& face) { faces_[next[range_of(face)]++] = face; });
    }
  }

  bool match() const {
    std::atomic<bool> conforming = true;
#pragma omp parallel if (ranges_ > 1)
    {
      std::vector<std::uint32_t> slots;
#pragma omp for schedule(dynamic, 1)
      for (std::size_t range = 0; range < ranges_; ++range) {
        if (!match_range({faces_.get() + first_[range], faces_.get() + first_[range + 1]}, slots)) {
          conforming = false;
        }
      }
    }
    return conforming;
  }

  /// What has no other side is on the outside.
  bool match_range(std::span<Face> faces, std::vector<std::uint32_t>& slots) const {
    slots.assign(std::bit_ceil(2 * faces.size() + 1), kNone);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      std::uint32_t& slot = slots[slot_of(faces, f, slots)];
      if (slot == kNone) {
        slot = f;
      } else if (!join(faces[slot], faces[f])) {
        return false;
      }
    }
    for (const Face& face : faces) {
      if (face.tet_and_node != kNone) {
        neighbours_[face.tet_and_node / 4][face.tet_and_node % 4] = kNoTet;
      }
    }
    return true;
  }

  /// Where the face is that has these nodes, or is to be.
  static std::size_t slot_of(std::span<const Face> faces, std::uint32_t f,
                             const std::vector<std::uint32_t>& slots) {
    const Face& face = faces[f];
    const std::uint64_t mixed = ((std::uint64_t{face.second} << 32U | face.third) + face.least * kMix) * kMix;
    std::size_t slot = (mixed >> 32U) & (slots.size() - 1);
    while (slots[slot] != kNone && !are_same(faces[slots[slot]], face)) {
      slot = (slot + 1) & (slots.size() - 1);
    }
    return slot;
  }

  static bool are_same(const Face& a, const Face& b) {
    return a.second == b.second && a.third == b.third && a.least == b.least;
  }

  /// Makes the tets neighbours; false when the first has one there.
  bool join(Face& a, Face& b) const {
    if (a.tet_and_node == kNone) {
      return false;
    }
    neighbours_[a.tet_and_node / 4][a.tet_and_node % 4] = b.tet_and_node / 4;
    neighbours_[b.tet_and_node / 4][b.tet_and_node % 4] = a.tet_and_node / 4;
    a.tet_and_node = b.tet_and_node = kNone;
    return true;
  }

  static constexpr std::uint64_t kMix = 0x9E3779B97F4A7C15ULL;
  const TetNodes& tets_;
  unsigned shift_;  // a vertex without its last bits is its range
  TetNeighbours& neighbours_;
  std::size_t blocks_, ranges_;
  std::unique_ptr<TetId[]> open_;  // block by block, its tets with an unknown neighbour, from its begin on
  std::vector<std::size_t> open_count_;
  std::vector<std::uint32_t> next_;   // block by block, where its next face of each range goes
  std::vector<std::uint32_t> first_;  // face of each range
  std::unique_ptr<Face[]> faces_;
};

}  // namespace

void find_unknown_neighbours(const TetNodes& tets, std::size_t vertex_count, TetNeighbours& neighbours) {
  if (!FaceMatcher(tets, vertex_count, neighbours).run()) {
    throw JobError("the tet mesh is not conforming: a face belongs to more than two tets");
  }
}

TetNeighbours tet_neighbours(const TetNodes& tets, std::size_t vertex_count) {
  TetNeighbours neighbours(tets.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < tets.size(); ++t) {
    neighbours[t].fill(kUnknownTet);
  }
  find_unknown_neighbours(tets, vertex_count, neighbours);
  return neighbours;
}

VertexCells tets_of_vertices(const TetNodes& tets, std::size_t vertex_count) {
  VertexCells around;
  around.first.assign(vertex_count + 1, 0);
  for_ranges(vertex_count, [&](std::size_t begin, std::size_t end) {
    for (const auto& tet : tets) {
      for (const VertexId v : tet) {
        if (v >= begin && v < end) {
          ++around.first[v + 1];
        }
      }
    }
  });
  sum_up(around.first);
  around.cells.resize(4 * tets.size());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for_ranges(vertex_count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = 0; t < tets.size(); ++t) {
      for (const VertexId v : tets[t]) {
        if (v >= begin && v < end) {
          around.cells[next[v]++] = static_cast<TetId>(t);
        }
      }
    }
  });
  return around;
}

}  // namespace cbc3d
