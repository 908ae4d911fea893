// A patch on its own, without an image.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "mesher/domain/boundary.hpp"
#include "mesher/improve/local/patch.hpp"

namespace cbc3d::testing {

/// A boundary that is everywhere, so that no guard for distances holds anything back.
class BoundaryEverywhere : public Boundary {
 public:
  [[nodiscard]] BoundarySample sample(const Vec3& /*x*/, MaterialId /*a*/, MaterialId /*b*/) const override {
    return {};
  }
};

/// A patch of a mesh whose points are to be covered by nobody.
inline Patch make_patch(TetComplex mesh, const Boundary& boundary) {
  static const std::vector<InterfacePoint> none;
  SurfaceCover cover(none, 1);
  cover.resize(mesh.vertex_count());
  std::vector<MaterialSet> sets(mesh.vertex_count());
  std::vector<TetId> star;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.locked(v) && mesh.in_use(v)) {
      mesh.star(v, star);
      sets[v] = mesh.materials(v, star);
    }
  }
  return {
      std::move(mesh), std::move(cover), std::move(sets), boundary, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
}

/// `count` tets around the edge 0, 1 of length 2 h, whose ring is a regular polygon of radius 1.
inline TetComplex tets_around_edge(std::size_t count, double h) {
  std::vector<Vec3> points = {{0, 0, -h}, {0, 0, h}};
  TetNodes tets;
  for (std::size_t n = 0; n < count; ++n) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(count);
    points.push_back({std::cos(angle), std::sin(angle), 0});
    tets.push_back({0, 1, static_cast<VertexId>(2 + n), static_cast<VertexId>(2 + (n + 1) % count)});
  }
  const std::size_t vertices = points.size();
  return {std::move(points), std::move(tets), std::vector<MaterialId>(count, 1),
          std::vector<std::uint8_t>(vertices, 0)};
}

/// Number, volume and worst angle of the tets.
struct Summary {
  std::size_t tets = 0;
  double volume_mm3 = 0;
  double worst_sine_squared = 1;
};
inline Summary summary_of(const TetComplex& mesh) {
  Summary sum;
  for (TetId t = 0; t < mesh.tet_slots(); ++t) {
    if (mesh.alive(t)) {
      const auto& n = mesh.nodes(t);
      ++sum.tets;
      sum.volume_mm3 +=
          six_volumes(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])) / 6;
      sum.worst_sine_squared = std::min(sum.worst_sine_squared, mesh.sine_squared(t));
    }
  }
  return sum;
}

}  // namespace cbc3d::testing
