// A box of cubes, six tets each.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d::testing {

/// n unit cubes along each axis, six tets each around the cubes' diagonals (Kuhn's triangulation); conforming
/// and positive.
struct KuhnBox {
  std::vector<Vec3> points;
  TetNodes tets;

  explicit KuhnBox(int n) {
    const auto at = [&](const Index3& p) {
      return static_cast<VertexId>((p[2] * (n + 1) + p[1]) * (n + 1) + p[0]);
    };
    for (int v = 0; v < (n + 1) * (n + 1) * (n + 1); ++v) {
      points.push_back({static_cast<double>(v % (n + 1)), static_cast<double>(v / (n + 1) % (n + 1)),
                        static_cast<double>(v / ((n + 1) * (n + 1)))});
    }
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
