// A patch on its own, without an image.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/improve/local/patch.hpp"
#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d::testing {

/// A domain whose boundaries are everywhere, so that no guard for distances holds anything back.
class BoundaryEverywhere : public Domain {
 public:
  [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
  [[nodiscard]] const std::vector<MaterialId>& label_of() const override { return label_of_; }
  [[nodiscard]] const std::vector<double>& volumes_mm3() const override { return volumes_mm3_; }
  [[nodiscard]] double scale_mm() const override { return 1; }
  [[nodiscard]] double cell_mm3() const override { return 1; }
  [[nodiscard]] double thin_reach_mm() const override { return std::numeric_limits<double>::infinity(); }
  [[nodiscard]] BoundaryDistance boundary_distance(const Vec3& /*x*/, MaterialId /*a*/,
                                                   MaterialId /*b*/) const override {
    return {};
  }
  [[nodiscard]] bool is_thin(const BoundarySample& /*sample*/) const override { return false; }
  [[nodiscard]] MaterialId material_at(const Vec3& /*x*/) const override { return 1; }
  [[nodiscard]] std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId /*material*/) const override {
    return x;
  }
  [[nodiscard]] bool is_near_boundary(const Vec3& /*x*/, MaterialId /*material*/) const override {
    return true;
  }

 protected:
  [[nodiscard]] std::vector<BoundarySample> find_samples() const override { return {}; }

 private:
  std::vector<Label> labels_{0, 1};
  std::vector<MaterialId> label_of_{0, 1};
  std::vector<double> volumes_mm3_{0, 0};
};

/// A patch of a mesh without samples to cover.
inline Patch make_patch(TetComplex mesh, const Domain& domain) {
  static const std::vector<BoundarySample> none;
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
  return {.mesh = std::move(mesh),
          .cover = std::move(cover),
          .sets = std::move(sets),
          .boundaries = {domain},
          .guards = {}};
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

/// Number, volume, worst quality and worst angle of the tets.
struct Summary {
  std::size_t tets = 0;
  double volume_mm3 = 0;
  double worst_quality = 1;
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
      sum.worst_quality = std::min(sum.worst_quality, mesh.quality(t));
      sum.worst_sine_squared =
          std::min(sum.worst_sine_squared,
                   min_sine_squared(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])));
    }
  }
  return sum;
}

}  // namespace cbc3d::testing
