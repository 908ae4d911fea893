#include "mesher/stages/tet_adjacency.hpp"

#include <omp.h>

#include <algorithm>
#include <atomic>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

using Face = std::array<VertexId, 3>;

Face sorted_face(const std::array<VertexId, 4>& tet, unsigned opposite) {
  Face face = {tet[kTetFace[opposite][0]], tet[kTetFace[opposite][1]], tet[kTetFace[opposite][2]]};
  std::sort(face.begin(), face.end());
  return face;
}

struct FaceEntry {
  VertexId second, third;      // of the sorted face; the first is the bucket
  std::uint32_t tet_and_node;  // 4 * tet + node opposite to the face
};

/// Faces bucketed by their smallest vertex: a counting sort, in the order of the tets.
struct FaceBuckets {
  std::vector<std::uint32_t> first;
  std::vector<FaceEntry> faces;
};

/// Calls f(face's smallest vertex, tet, node) for the faces whose smallest vertex is in [begin, end), in
/// order.
template <typename F>
void for_each_face(const TetNodes& tets, VertexId begin, VertexId end, const F& f) {
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto& tet = tets[t];
    for (unsigned n = 0; n < 4; ++n) {
      const VertexId least = std::min({tet[kTetFace[n][0]], tet[kTetFace[n][1]], tet[kTetFace[n][2]]});
      if (least >= begin && least < end) {
        f(least, t, n);
      }
    }
  }
}

/// Each thread fills the buckets of a range of vertices and passes over all tets for it: reading them again
/// costs less than the scattered writes, of which every thread has its share.
FaceBuckets bucket_faces(const TetNodes& tets, std::size_t vertex_count) {
  FaceBuckets buckets;
  buckets.first.assign(vertex_count + 1, 0);
  buckets.faces.resize(4 * tets.size());
  const auto parts = static_cast<std::size_t>(std::min(8, omp_get_max_threads()));
  const auto begin_of = [&](std::size_t part) { return static_cast<VertexId>(part * vertex_count / parts); };
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    for_each_face(tets, begin_of(part), begin_of(part + 1),
                  [&](VertexId least, std::size_t, unsigned) { ++buckets.first[least + 1]; });
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    buckets.first[v + 1] += buckets.first[v];
  }
  std::vector<std::uint32_t> next(buckets.first.begin(), buckets.first.end() - 1);
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    for_each_face(tets, begin_of(part), begin_of(part + 1), [&](VertexId least, std::size_t t, unsigned n) {
      const Face face = sorted_face(tets[t], n);
      buckets.faces[next[least]++] = {face[1], face[2], static_cast<std::uint32_t>(4 * t + n)};
    });
  }
  return buckets;
}

/// Pairs equal faces of one bucket. Buckets are small (a few dozen), so each is sorted on its own.
bool match_bucket(FaceEntry* begin, FaceEntry* end, std::vector<std::array<TetId, 4>>& neighbours) {
  std::sort(begin, end, [](const FaceEntry& a, const FaceEntry& b) {
    return a.second != b.second ? a.second < b.second
           : a.third != b.third ? a.third < b.third
                                : a.tet_and_node < b.tet_and_node;
  });
  const auto same = [](const FaceEntry& a, const FaceEntry& b) {
    return a.second == b.second && a.third == b.third;
  };
  for (FaceEntry* face = begin; face + 1 < end; ++face) {
    if (same(face[0], face[1])) {
      if (face + 2 < end && same(face[1], face[2])) {
        return false;
      }
      neighbours[face[0].tet_and_node / 4][face[0].tet_and_node % 4] = face[1].tet_and_node / 4;
      neighbours[face[1].tet_and_node / 4][face[1].tet_and_node % 4] = face[0].tet_and_node / 4;
      ++face;
    }
  }
  return true;
}

}  // namespace

std::vector<std::array<TetId, 4>> tet_neighbours(const TetNodes& tets, std::size_t vertex_count) {
  FaceBuckets buckets = bucket_faces(tets, vertex_count);
  std::vector<std::array<TetId, 4>> neighbours(tets.size(), {kNoTet, kNoTet, kNoTet, kNoTet});
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
  return neighbours;
}

VertexTets tets_of_vertices(const TetNodes& tets, std::size_t vertex_count) {
  VertexTets around;
  around.first.assign(vertex_count + 1, 0);
  for (const auto& tet : tets) {
    for (const VertexId v : tet) {
      ++around.first[v + 1];
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    around.first[v + 1] += around.first[v];
  }
  around.tets.resize(4 * tets.size());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (const VertexId v : tets[t]) {
      around.tets[next[v]++] = static_cast<TetId>(t);
    }
  }
  return around;
}

}  // namespace cbc3d
