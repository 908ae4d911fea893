// A box of small tets.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d::testing {

/// A box of unit cubes, six tets each around the diagonal; conforming, materials by `material_at` of the
/// centroid.
struct Box {
  std::vector<Vec3> points;
  TetNodes tets;
  std::vector<MaterialId> materials;

  explicit Box(
      int n, const std::function<int(const Vec3&)>& material_at = [](const Vec3&) { return 1; }) {
    const auto at = [&](int i, int j, int k) {
      return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
    };
    for (int v = 0; v < (n + 1) * (n + 1) * (n + 1); ++v) {
      points.push_back({static_cast<double>(v % (n + 1)), static_cast<double>(v / (n + 1) % (n + 1)),
                        static_cast<double>(v / ((n + 1) * (n + 1)))});
    }
    constexpr std::array<std::array<int, 3>, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (int cube = 0; cube < n * n * n; ++cube) {
      for (const auto& order : kOrders) {
        Index3 p = {cube % n, cube / n % n, cube / (n * n)};
        std::array<VertexId, 4> nodes{};
        Vec3 centroid;
        for (std::size_t s = 0; s < 4; ++s) {
          nodes[s] = at(p[0], p[1], p[2]);
          centroid += 0.25 * points[nodes[s]];
          if (s < 3) ++p[static_cast<std::size_t>(order[s])];
        }
        if (six_volumes(points[nodes[0]], points[nodes[1]], points[nodes[2]], points[nodes[3]]) < 0) {
          std::swap(nodes[2], nodes[3]);
        }
        tets.push_back(nodes);
        materials.push_back(static_cast<MaterialId>(material_at(centroid)));
      }
    }
  }
  [[nodiscard]] TetComplex complex() const {
    return {points, tets, materials, std::vector<std::uint8_t>(points.size(), 0)};
  }
};

}  // namespace cbc3d::testing
