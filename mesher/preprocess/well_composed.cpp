#include "mesher/preprocess/well_composed.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace cbc3d {
namespace {

using Cell = std::array<MaterialId, 8>;  // corner c is one voxel on along x where bit 0 of c is set, y 1, z 2

/// The corners around a square of a cell, in order.
using Square = std::array<std::uint8_t, 4>;
constexpr std::array<Square, 6> kSquares = {
    {{0, 1, 3, 2}, {0, 2, 6, 4}, {0, 4, 5, 1}, {4, 5, 7, 6}, {1, 3, 7, 5}, {2, 6, 7, 3}}};
constexpr std::size_t kOwnSquares = 3;  // those at corner 0; the others belong to cells further on

bool is_diagonal(const Cell& cell, const Square& s, std::size_t from) {
  const MaterialId m = cell[s[from]];
  const MaterialId one = cell[s[from + 1]];
  const MaterialId other = cell[s[(from + 3) % 4]];
  return m == cell[s[from + 2]] && m != one && m != other && (m != kBackground || one == other);
}

bool has_edge_contact(const Cell& cell, const Square& s) {
  return is_diagonal(cell, s, 0) || is_diagonal(cell, s, 1);
}

/// True for a contact between corners c and 7 - c.
bool has_vertex_contact(const Cell& cell, std::size_t c) {
  const MaterialId first = cell[c];
  const MaterialId last = cell[7 - c];
  const MaterialId other = cell[c ^ 1U];
  bool none = true;
  bool all = true;
  for (std::size_t o = 0; o < 8; ++o) {
    if (o != c && o != 7 - c) {
      none = none && cell[o] != first;
      all = all && cell[o] == other;
    }
  }
  return (first == last && first != kBackground && none) ||
         (all && other != kBackground && first != other && last != other);
}

/// What a place's contact may become.
struct Change {
  std::array<Index3, 2> voxels;
  std::size_t count = 1;  // of voxels
  MaterialId to = kBackground;
};

enum class Kind { join, cut, last_resort };

class Composer {
 public:
  explicit Composer(LabelImage& image) : image_(image) { report_.gained.assign(image.material_count(), 0); }

  ContactReport run() {
    std::vector<std::size_t> places = places_in_image();
    count_kinds(places);
    while (!places.empty() && changes_are_possible_) {
      ++report_.rounds;
      changes_are_possible_ = false;
      near_changes_.clear();
      for (const std::size_t place : places) {
        resolve(place);
      }
      places.insert(places.end(), near_changes_.begin(), near_changes_.end());
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      std::erase_if(
          places, [this](std::size_t place) { return !has_contact(cell_at(image_.frame.index_of(place))); });
    }
    report_.contacts_left = places.size();
    return std::move(report_);
  }

 private:
  static constexpr std::uint8_t kMostChanges = 3;  // of a voxel

  [[nodiscard]] MaterialId at(const Index3& v) const { return image_.at_or_background(v[0], v[1], v[2]); }

  static Index3 corner_of(const Index3& low, std::size_t c) {
    return {low[0] + static_cast<int>(c & 1U), low[1] + static_cast<int>(c >> 1U & 1U),
            low[2] + static_cast<int>(c >> 2U)};
  }

  [[nodiscard]] Cell cell_at(const Index3& low) const {
    Cell cell{};
    for (std::size_t c = 0; c < 8; ++c) {
      cell[c] = at(corner_of(low, c));
    }
    return cell;
  }

  static bool is_uniform(const Cell& cell) {
    return std::all_of(cell.begin(), cell.end(), [&](MaterialId m) { return m == cell[0]; });
  }

  /// In the squares at corner 0, or in the cell.
  static bool has_contact(const Cell& cell) {
    return std::any_of(kSquares.begin(), kSquares.begin() + kOwnSquares,
                       [&](const Square& s) { return has_edge_contact(cell, s); }) ||
           has_vertex_contact(cell, 0) || has_vertex_contact(cell, 1) || has_vertex_contact(cell, 2) ||
           has_vertex_contact(cell, 3);
  }

  /// The lowest voxels of the cells with a contact, ascending. There are none across the image's border: the
  /// outside is background throughout.
  [[nodiscard]] std::vector<std::size_t> places_in_image() const {
    const Index3& size = image_.frame.size;
    std::vector<std::vector<std::size_t>> found(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        add_places_of_row(j, k, found[static_cast<std::size_t>(k)]);
      }
    }
    std::vector<std::size_t> places;
    for (const auto& slice : found) {
      places.insert(places.end(), slice.begin(), slice.end());
    }
    return places;
  }

  void add_places_of_row(int j, int k, std::vector<std::size_t>& places) const {
    const Index3& size = image_.frame.size;
    const bool inner = j + 1 < size[1] && k + 1 < size[2];
    const std::size_t row = image_.frame.offset(0, j, k);
    image_.voxels.visit([&](const auto* voxels) {
      const auto* r0 = voxels + row;
      const auto* r1 = inner ? voxels + image_.frame.offset(0, j + 1, k) : r0;
      const auto* r2 = inner ? voxels + image_.frame.offset(0, j, k + 1) : r0;
      const auto* r3 = inner ? voxels + image_.frame.offset(0, j + 1, k + 1) : r0;
      for (int i = 0; i < size[0]; ++i) {
        const int next = std::min(i + 1, size[0] - 1);
        const bool plain = inner && r0[i] == r1[i] && r0[i] == r2[i] && r0[i] == r3[i] && r0[i] == r0[next] &&
                           r0[i] == r1[next] && r0[i] == r2[next] && r0[i] == r3[next];
        if (!plain && has_contact(cell_at({i, j, k}))) {
          places.push_back(row + static_cast<std::size_t>(i));
        }
      }
    });
  }

  void count_kinds(const std::vector<std::size_t>& places) {
    for (const std::size_t place : places) {
      const Cell cell = cell_at(image_.frame.index_of(place));
      for (std::size_t s = 0; s < kOwnSquares; ++s) {
        report_.edge_contacts += has_edge_contact(cell, kSquares[s]) ? 1 : 0;
      }
      for (std::size_t c = 0; c < 4; ++c) {
        report_.vertex_contacts += has_vertex_contact(cell, c) ? 1 : 0;
      }
    }
  }

  /// The contacts of all squares and cells that a voxel is in.
  [[nodiscard]] int contacts_around(const Index3& v) const {
    int count = 0;
    for (std::size_t c = 0; c < 8; ++c) {
      const std::size_t mirror = 7 - c;  // the corner at which v is
      const Index3 low = {v[0] - static_cast<int>(mirror & 1U), v[1] - static_cast<int>(mirror >> 1U & 1U),
                          v[2] - static_cast<int>(mirror >> 2U)};
      const Cell cell = cell_at(low);
      if (is_uniform(cell)) {
        continue;
      }
      for (std::size_t d = 0; d < 4; ++d) {
        count += has_vertex_contact(cell, d) ? 2 : 0;
      }
      for (const Square& s : kSquares) {  // each square with v is in two of the cells
        const bool has_v = std::find(s.begin(), s.end(), mirror) != s.end();
        count += has_v && has_edge_contact(cell, s) ? 1 : 0;
      }
    }
    return count;
  }

  /// Resolves the contacts of one place, as it is when its turn comes.
  void resolve(std::size_t place) {
    const Index3 low = image_.frame.index_of(place);
    for (int turn = 0; turn < 8; ++turn) {
      const Cell cell = cell_at(low);
      if (!has_contact(cell) || !make_best_change(low, cell)) {
        return;
      }
    }
  }

  bool make_best_change(const Index3& low, const Cell& cell) {
    best_.reset();
    for (std::size_t s = 0; s < kOwnSquares; ++s) {
      if (has_edge_contact(cell, kSquares[s])) {
        consider_square(low, cell, kSquares[s]);
      }
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (has_vertex_contact(cell, c)) {
        consider_diagonal(low, cell, c);
      }
    }
    if (!best_) {
      return false;
    }
    carry_out(best_->second);
    return true;
  }

  /// Each of the four voxels may become what one beside it is.
  void consider_square(const Index3& low, const Cell& cell, const Square& s) {
    for (std::size_t n = 0; n < 4; ++n) {
      for (const std::size_t beside : {(n + 1) % 4, (n + 3) % 4}) {
        consider({{corner_of(low, s[n])}, 1, cell[s[beside]]});
      }
    }
  }

  /// Either end may become what is beside it; the two voxels of a path between the ends what an end is.
  void consider_diagonal(const Index3& low, const Cell& cell, std::size_t c) {
    for (const std::size_t end : {c, 7 - c}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        consider({{corner_of(low, end)}, 1, cell[end ^ (1U << axis)]});
        for (std::size_t second = 0; second < 3; ++second) {
          if (second != axis) {
            const std::size_t one = end ^ (std::size_t{1} << axis);
            consider({{corner_of(low, one), corner_of(low, one ^ (std::size_t{1} << second))}, 2, cell[end]});
          }
        }
      }
    }
  }

  /// What decides between changes, less is better.
  using Score = std::tuple<bool, Kind, int, int>;

  void consider(const Change& change) {
    for (std::size_t n = 0; n < change.count; ++n) {
      if (!image_.frame.contains(change.voxels[n][0], change.voxels[n][1], change.voxels[n][2]) ||
          at(change.voxels[n]) == change.to || changes_of(change.voxels[n]) >= kMostChanges ||
          is_last_of_part(change.voxels[n])) {
        return;
      }
    }
    const int fewer = try_out(change);
    const Score score = {fewer >= 0, kind_of(change), fewer, -support_of(change)};
    if (!best_ || score < best_->first) {
      best_ = {score, change};
    }
  }

  [[nodiscard]] int changes_of(const Index3& v) const {
    const auto found = changes_.find(image_.frame.offset(v[0], v[1], v[2]));
    return found == changes_.end() ? 0 : found->second;
  }

  [[nodiscard]] bool has_own_beside(const Index3& v) const {
    const MaterialId own = at(v);
    for (std::size_t side = 0; side < 6; ++side) {
      Index3 next = v;
      next[side / 2] += side % 2 == 0 ? 1 : -1;
      if (at(next) == own) {
        return true;
      }
    }
    return false;
  }

  /// A part of one voxel, of a label, would vanish.
  [[nodiscard]] bool is_last_of_part(const Index3& v) const {
    return at(v) != kBackground && !has_own_beside(v);
  }

  [[nodiscard]] Kind kind_of(const Change& change) const {
    Kind kind = change.to == kBackground ? Kind::cut : Kind::join;
    for (std::size_t n = 0; n < change.count; ++n) {
      kind = has_own_beside(change.voxels[n]) ? kind : Kind::last_resort;  // a cavity would be filled
    }
    return kind;
  }

  /// The contacts after a change less those before.
  int try_out(const Change& change) {
    int difference = 0;
    std::array<MaterialId, 2> before{};
    for (std::size_t n = 0; n < change.count; ++n) {
      const Index3& v = change.voxels[n];
      before[n] = at(v);
      difference -= contacts_around(v);
      image_.voxels.set(image_.frame.offset(v[0], v[1], v[2]), change.to);
      difference += contacts_around(v);
    }
    for (std::size_t n = 0; n < change.count; ++n) {
      const Index3& v = change.voxels[n];
      image_.voxels.set(image_.frame.offset(v[0], v[1], v[2]), before[n]);
    }
    return difference;
  }

  /// How much more of the voxels around are of the new label than of the old: 4 for one across a face, 2
  /// across an edge, 1 across a corner.
  [[nodiscard]] int support_of(const Change& change) const {
    int sum = 0;
    for (std::size_t n = 0; n < change.count; ++n) {
      const Index3& v = change.voxels[n];
      const MaterialId own = at(v);
      for (int k = -1; k <= 1; ++k) {
        for (int j = -1; j <= 1; ++j) {
          for (int i = -1; i <= 1; ++i) {
            const MaterialId m = at({v[0] + i, v[1] + j, v[2] + k});
            const int weight = 8 >> (std::abs(i) + std::abs(j) + std::abs(k));
            sum += weight * ((m == change.to ? 1 : 0) - (m == own ? 1 : 0));
          }
        }
      }
    }
    return sum;
  }

  void carry_out(const Change& change) {
    changes_are_possible_ = true;
    ++(change.to == kBackground ? report_.cut : report_.joined);
    for (std::size_t n = 0; n < change.count; ++n) {
      const Index3& v = change.voxels[n];
      const std::size_t offset = image_.frame.offset(v[0], v[1], v[2]);
      --report_.gained[image_.voxels[offset]];
      ++report_.gained[change.to];
      image_.voxels.set(offset, change.to);
      ++changes_[offset];
      ++report_.voxels_changed;
      add_places_around(v);
    }
  }

  void add_places_around(const Index3& v) {
    for (int k = std::max(0, v[2] - 1); k <= v[2]; ++k) {
      for (int j = std::max(0, v[1] - 1); j <= v[1]; ++j) {
        for (int i = std::max(0, v[0] - 1); i <= v[0]; ++i) {
          near_changes_.push_back(image_.frame.offset(i, j, k));
        }
      }
    }
  }

  LabelImage& image_;
  std::unordered_map<std::size_t, std::uint8_t> changes_;  // of voxels, by offset; looked up, never walked
  std::vector<std::size_t> near_changes_;
  std::optional<std::pair<Score, Change>> best_;
  bool changes_are_possible_ = true;
  ContactReport report_;
};

}  // namespace

ContactReport make_well_composed(LabelImage& image) {
  return Composer(image).run();
}

}  // namespace cbc3d
