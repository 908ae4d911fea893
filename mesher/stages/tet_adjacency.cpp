#include "mesher/stages/tet_adjacency.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>

#include "mesher/core/error.hpp"
#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

using Face = std::array<VertexId, 3>;

Face sorted_face(const std::array<VertexId, 4>& tet, unsigned opposite) {
  VertexId a = tet[kTetFace[opposite][0]];
  VertexId b = tet[kTetFace[opposite][1]];
  VertexId c = tet[kTetFace[opposite][2]];
  const auto order = [](VertexId& low, VertexId& high) {
    const VertexId least = std::min(low, high);
    high = std::max(low, high);
    low = least;
  };
  order(a, b);
  order(b, c);
  order(a, b);
  return {a, b, c};
}

using Neighbours = std::vector<std::array<TetId, 4>>;

struct FaceEntry {
  VertexId second, third;      // of the sorted face; the first is the bucket
  std::uint32_t tet_and_node;  // 4 * tet + node opposite to the face

  [[nodiscard]] std::uint64_t others() const { return std::uint64_t{second} << 32U | third; }
};

/// Faces of unknown neighbours, bucketed by their smallest vertex: a counting sort, in the order of the tets.
struct FaceBuckets {
  std::vector<std::uint32_t> first;
  std::vector<FaceEntry> faces;
};

/// Runs f(begin, end) for ranges that the vertices are cut in, one a thread. Each thread fills the rows of
/// its vertices and passes over all tets for it: reading them again costs less than the scattered writes, of
/// which every thread has its share.
template <typename F>
void for_vertex_ranges(std::size_t vertex_count, const F& f) {
  const auto parts = static_cast<std::size_t>(std::min(8, omp_get_max_threads()));
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    f(static_cast<VertexId>(part * vertex_count / parts),
      static_cast<VertexId>((part + 1) * vertex_count / parts));
  }
}

/// Tets with an unknown neighbour, ascending: in a late round of a refinement few of all.
std::vector<TetId> tets_to_match(const Neighbours& neighbours) {
  return indices_where(neighbours.size(), [&](std::size_t t) {
    const auto& across = neighbours[t];
    return std::find(across.begin(), across.end(), kUnknownTet) != across.end();
  });
}

/// Calls f(face's smallest vertex, tet, node) for the faces of unknown neighbours of the tets `open` whose
/// smallest vertex is in [begin, end), in order.
template <typename F>
void for_each_face(const TetNodes& tets, const Neighbours& neighbours, const std::vector<TetId>& open,
                   VertexId begin, VertexId end, const F& f) {
  for (const TetId t : open) {
    const auto& across = neighbours[t];
    // The smallest node is in every face but the one opposite to it, whose smallest is the second.
    const auto& tet = tets[t];
    const auto [low_a, high_a] = std::minmax(tet[0], tet[1]);
    const auto [low_b, high_b] = std::minmax(tet[2], tet[3]);
    const VertexId first = std::min(low_a, low_b);
    const VertexId second = std::min(std::max(low_a, low_b), first == low_a ? high_a : high_b);
    for (unsigned n = 0; n < 4; ++n) {
      const VertexId least = tet[n] == first ? second : first;
      if (across[n] == kUnknownTet && least >= begin && least < end) {
        f(least, t, n);
      }
    }
  }
}

/// Counts in first[i + 1] become the places where the rows begin.
void sum_up(std::vector<std::uint32_t>& first) {
  for (std::size_t i = 1; i < first.size(); ++i) {
    first[i] += first[i - 1];
  }
}

FaceBuckets bucket_faces(const TetNodes& tets, const Neighbours& neighbours, std::size_t vertex_count) {
  const std::vector<TetId> open = tets_to_match(neighbours);
  FaceBuckets buckets;
  buckets.first.assign(vertex_count + 1, 0);
  for_vertex_ranges(vertex_count, [&](VertexId begin, VertexId end) {
    for_each_face(tets, neighbours, open, begin, end,
                  [&](VertexId least, TetId, unsigned) { ++buckets.first[least + 1]; });
  });
  sum_up(buckets.first);
  buckets.faces.resize(buckets.first.back());
  std::vector<std::uint32_t> next(buckets.first.begin(), buckets.first.end() - 1);
  for_vertex_ranges(vertex_count, [&](VertexId begin, VertexId end) {
    for_each_face(tets, neighbours, open, begin, end, [&](VertexId least, TetId t, unsigned n) {
      const Face face = sorted_face(tets[t], n);
      buckets.faces[next[least]++] = {face[1], face[2], 4 * t + n};
    });
  });
  return buckets;
}

/// Pairs equal faces of one bucket. Buckets are small (a few dozen), so each is sorted on its own. What has
/// no other side is on the outside.
bool match_bucket(FaceEntry* begin, FaceEntry* end, Neighbours& neighbours) {
  std::sort(begin, end, [](const FaceEntry& a, const FaceEntry& b) { return a.others() < b.others(); });
  for (FaceEntry* face = begin; face < end; ++face) {
    TetId& across = neighbours[face->tet_and_node / 4][face->tet_and_node % 4];
    if (face + 1 == end || face[1].others() != face[0].others()) {
      across = kNoTet;
      continue;
    }
    if (face + 2 < end && face[2].others() == face[0].others()) {
      return false;
    }
    across = face[1].tet_and_node / 4;
    neighbours[face[1].tet_and_node / 4][face[1].tet_and_node % 4] = face[0].tet_and_node / 4;
    ++face;
  }
  return true;
}

}  // namespace

void find_unknown_neighbours(const TetNodes& tets, std::size_t vertex_count, Neighbours& neighbours) {
  FaceBuckets buckets = bucket_faces(tets, neighbours, vertex_count);
  std::atomic<bool> conforming = true;
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t v = 0; v < vertex_count; ++v) {
    FaceEntry* const faces = buckets.faces.data();
    if (!match_bucket(faces + buckets.first[v], faces + buckets.first[v + 1], neighbours)) {
      conforming = false;
    }
  }
  if (!conforming) {
    throw JobError("the tet mesh is not conforming: a face belongs to more than two tets");
  }
}

std::vector<std::array<TetId, 4>> tet_neighbours(const TetNodes& tets, std::size_t vertex_count) {
  Neighbours neighbours(tets.size(), {kUnknownTet, kUnknownTet, kUnknownTet, kUnknownTet});
  find_unknown_neighbours(tets, vertex_count, neighbours);
  return neighbours;
}

VertexTets tets_of_vertices(const TetNodes& tets, std::size_t vertex_count) {
  VertexTets around;
  around.first.assign(vertex_count + 1, 0);
  for_vertex_ranges(vertex_count, [&](VertexId begin, VertexId end) {
    for (const auto& tet : tets) {
      for (const VertexId v : tet) {
        if (v >= begin && v < end) {
          ++around.first[v + 1];
        }
      }
    }
  });
  sum_up(around.first);
  around.tets.resize(4 * tets.size());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for_vertex_ranges(vertex_count, [&](VertexId begin, VertexId end) {
    for (std::size_t t = 0; t < tets.size(); ++t) {
      for (const VertexId v : tets[t]) {
        if (v >= begin && v < end) {
          around.tets[next[v]++] = static_cast<TetId>(t);
        }
      }
    }
  });
  return around;
}

}  // namespace cbc3d
