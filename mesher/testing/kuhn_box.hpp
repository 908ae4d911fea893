// A box of cubes, six tets each.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/testing/cube_corners.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d::testing {

/// n unit cubes along each axis, six tets each around the cubes' diagonals (Kuhn's triangulation); conforming
/// and positive.
struct KuhnBox {
  std::vector<Vec3> points;
  TetNodes tets;

  explicit KuhnBox(int n) {
    points = cube_corners(n);
    const auto at = [n](const Index3& p) { return cube_corner(n, p[0], p[1], p[2]); };
    constexpr std::array<std::array<std::size_t, 3>, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (int cube = 0; cube < n * n * n; ++cube) {
      for (const auto& order : kOrders) {
        Index3 p = {cube % n, cube / n % n, cube / (n * n)};
        std::array<VertexId, 4> nodes = {at(p), 0, 0, 0};
        for (std::size_t step = 0; step < 3; ++step) {
          ++p[order[step]];
          nodes[step + 1] = at(p);
        }
        if (six_volumes(points[nodes[0]], points[nodes[1]], points[nodes[2]], points[nodes[3]]) < 0) {
          std::swap(nodes[2], nodes[3]);
        }
        tets.push_back(nodes);
      }
    }
  }

  [[nodiscard]] Vec3 centroid(std::size_t tet) const {
    Vec3 sum;
    for (const VertexId v : tets[tet]) sum += 0.25 * points[v];
    return sum;
  }
};

}  // namespace cbc3d::testing
