// What a labelled tet mesh must be, judged by its faces alone: no code shared with the stages that see to it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d::testing {

using FaceKey = std::array<VertexId, 3>;

inline FaceKey face_key(const std::array<VertexId, 4>& nodes, std::size_t opposite) {
  FaceKey key = {nodes[kTetFace[opposite][0]], nodes[kTetFace[opposite][1]], nodes[kTetFace[opposite][2]]};
  std::sort(key.begin(), key.end());
  return key;
}

/// The faces that exactly one tet of the label has.
template <typename LabelT>
std::vector<FaceKey> surface_of_label(const TetNodes& tets, const std::vector<LabelT>& labels, LabelT label) {
  std::map<FaceKey, int> faces;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (std::size_t n = 0; labels[t] == label && n < 4; ++n) {
      ++faces[face_key(tets[t], n)];
    }
  }
  std::vector<FaceKey> surface;
  for (const auto& [face, count] : faces) {
    if (count == 1) surface.push_back(face);
  }
  return surface;
}

struct Faults {
  std::size_t edges = 0;     // with other than two facets of a label's surface
  std::size_t vertices = 0;  // whose facets form more than one fan
};

/// Where a surface is non-manifold.
inline Faults faults_of_surface(const std::vector<FaceKey>& surface) {
  std::map<std::array<VertexId, 2>, int> edges;
  std::map<VertexId, std::vector<std::array<VertexId, 2>>> rims;  // for each vertex, the sides across from it
  for (const FaceKey& f : surface) {
    for (std::size_t i = 0; i < 3; ++i) {
      const VertexId a = f[(i + 1) % 3];
      const VertexId b = f[(i + 2) % 3];
      ++edges[{std::min(a, b), std::max(a, b)}];
      rims[f[i]].push_back({a, b});
    }
  }
  Faults faults;
  for (const auto& [e, count] : edges) faults.edges += count != 2 ? 1 : 0;
  for (auto& [v, rim] : rims) {
    std::set<VertexId> reached = {rim[0][0]};
    for (std::size_t grown = 0; grown != reached.size();) {
      grown = reached.size();
      for (const auto& e : rim) {
        if (reached.count(e[0]) + reached.count(e[1]) > 0) reached.insert({e[0], e[1]});
      }
    }
    std::set<VertexId> all;
    for (const auto& e : rim) all.insert({e[0], e[1]});
    faults.vertices += reached.size() != all.size() ? 1 : 0;
  }
  return faults;
}

/// Vertices - edges + faces: 2 for a sphere, 0 for a torus, summed over components.
inline long euler_characteristic(const std::vector<FaceKey>& surface) {
  std::set<VertexId> vertices;
  std::set<std::array<VertexId, 2>> edges;
  for (const FaceKey& f : surface) {
    vertices.insert(f.begin(), f.end());
    edges.insert({{f[0], f[1]}, {f[0], f[2]}, {f[1], f[2]}});
  }
  return static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
         static_cast<long>(surface.size());
}

/// Faces that more than two tets have; 0 in a conforming mesh without overlaps.
inline std::size_t crowded_faces(const TetNodes& tets) {
  std::map<FaceKey, int> faces;
  for (const auto& nodes : tets) {
    for (std::size_t n = 0; n < 4; ++n) ++faces[face_key(nodes, n)];
  }
  return static_cast<std::size_t>(
      std::count_if(faces.begin(), faces.end(), [](const auto& f) { return f.second > 2; }));
}

inline std::size_t inverted_tets(const TetNodes& tets, const std::vector<Vec3>& points) {
  return static_cast<std::size_t>(std::count_if(tets.begin(), tets.end(), [&](const auto& n) {
    return !(six_volumes(points[n[0]], points[n[1]], points[n[2]], points[n[3]]) > 0);
  }));
}

/// Mean angle between the true normals of a ball and those of the facets of its surface, by area, degrees.
inline double normal_error_deg(const std::vector<FaceKey>& surface, const std::vector<Vec3>& points,
                               const Vec3& centre) {
  double sum = 0;
  double areas = 0;
  for (const FaceKey& f : surface) {
    const Vec3 normal = (points[f[1]] - points[f[0]]).cross(points[f[2]] - points[f[0]]);
    const Vec3 outwards = (points[f[0]] + points[f[1]] + points[f[2]]) / 3 - centre;
    const double cosine = std::abs(normal.normalized().dot(outwards.normalized()));
    sum += normal.norm() * std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
    areas += normal.norm();
  }
  return sum / areas;
}

}  // namespace cbc3d::testing
