// A box of small tets whose materials are given by place.
#pragma once

#include <functional>

#include "mesher/improve/local/tet_complex.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d::testing {

/// A box of unit cubes, six tets each, whose materials are those of their centroids.
struct Box : KuhnBox {
  std::vector<MaterialId> materials;

  explicit Box(
      int n, const std::function<int(const Vec3&)>& material_at = [](const Vec3&) { return 1; })
      : KuhnBox(n) {
    for (std::size_t t = 0; t < tets.size(); ++t) {
      materials.push_back(static_cast<MaterialId>(material_at(centroid(t))));
    }
  }
  [[nodiscard]] TetComplex complex() const {
    return {points, tets, materials, std::vector<std::uint8_t>(points.size(), 0)};
  }
};

}  // namespace cbc3d::testing
