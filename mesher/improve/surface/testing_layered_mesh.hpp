// A box of small tets in two layers, and what an image of it would say.
#pragma once

#include <algorithm>
#include <cmath>

#include "mesher/domain/domain.hpp"
#include "mesher/improve/local/mesh_star.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d::testing {

/// n cubes along each axis, six tets each; material 1 below the plane z = level, 2 above.
inline MaterialMesh two_layers(int n, double level) {
  MaterialMesh mesh;
  const auto vertex = [&](int i, int j, int k) {
    return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
  };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) mesh.points.push_back({1.0 * i, 1.0 * j, 1.0 * k});
    }
  }
  constexpr std::array<std::array<int, 3>, 6> kOrders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (int cube = 0; cube < n * n * n; ++cube) {
    const std::array<int, 3> low = {cube % n, cube / n % n, cube / (n * n)};
    for (std::size_t o = 0; o < kOrders.size(); ++o) {
      std::array<VertexId, 4> tet{};
      std::array<int, 3> at = low;
      tet[0] = vertex(at[0], at[1], at[2]);
      for (std::size_t step = 0; step < 3; ++step) {
        ++at[static_cast<std::size_t>(kOrders[o][step])];
        tet[step + 1] = vertex(at[0], at[1], at[2]);
      }
      if (o >= 3) std::swap(tet[2], tet[3]);  // odd orders are left-handed
      mesh.tets.push_back(tet);
      mesh.materials.push_back(low[2] < level ? 1 : 2);
    }
  }
  return mesh;
}

/// Takes out the layer of cubes above z = 2 of n layers, and moves the vertex (3, 3, 2) below the gap to
/// `tip`.
inline void open_gap(MaterialMesh& mesh, int n, const Vec3& tip) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    double lowest = n;
    for (const VertexId v : mesh.tets[t]) lowest = std::min(lowest, mesh.points[v].z);
    if (lowest != 2) {
      mesh.tets[kept] = mesh.tets[t];
      mesh.materials[kept++] = mesh.materials[t];
    }
  }
  mesh.tets.resize(kept);
  mesh.materials.resize(kept);
  *std::find(mesh.points.begin(), mesh.points.end(), Vec3{3, 3, 2}) = tip;
}

inline std::size_t faults(const MaterialMesh& mesh) {
  std::size_t sum = 0;
  for (const MaterialId m : {1, 2}) {
    const auto of_label = faults_of_surface(surface_of_label(mesh.tets, mesh.materials, MaterialId{m}));
    sum += of_label.edges + of_label.vertices;
  }
  return sum;
}

/// The plane z = level, as two_layers has it, is where materials 1 and 2 meet; the sides of the box of n
/// cubes bound both. Distances beyond `near` are far.
class PlaneDomain : public Domain {
 public:
  PlaneDomain(int n, double level, double near, std::vector<BoundarySample> samples, std::size_t materials)
      : n_(n), level_(level), near_(near), samples_(std::move(samples)), volumes_mm3_(materials, 0) {
    for (std::size_t m = 0; m < materials; ++m) {
      labels_.push_back(static_cast<Label>(m));
      label_of_.push_back(static_cast<MaterialId>(m));
    }
  }

  [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
  [[nodiscard]] const std::vector<MaterialId>& label_of() const override { return label_of_; }
  [[nodiscard]] const std::vector<double>& volumes_mm3() const override { return volumes_mm3_; }
  [[nodiscard]] double scale_mm() const override { return 1; }
  [[nodiscard]] double cell_mm3() const override { return 1; }
  [[nodiscard]] double thin_reach_mm() const override { return 1; }
  [[nodiscard]] BoundaryDistance boundary_distance(const Vec3& x, MaterialId a, MaterialId) const override {
    const double depth = a == 1 ? level_ - x.z : x.z - level_;
    return {depth, {0, 0, a == 1 ? -1.0 : 1.0}, std::fabs(depth), true};
  }
  [[nodiscard]] bool is_thin(const BoundarySample&) const override { return false; }
  [[nodiscard]] MaterialId material_at(const Vec3& x) const override {
    return static_cast<MaterialId>(x.z < level_ ? 1 : 2);
  }
  [[nodiscard]] std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId m) const override {
    return m == kBackground ? x : Vec3{x.x, x.y, level_};
  }
  [[nodiscard]] bool is_near_boundary(const Vec3& x, MaterialId m) const override {
    const bool outside = std::min({x.x, x.y, x.z, n_ - x.x, n_ - x.y, n_ - x.z}) <= 0;
    return m == kBackground || outside || std::fabs(x.z - level_) <= near_;
  }

 protected:
  [[nodiscard]] std::vector<BoundarySample> find_samples() const override { return samples_; }

 private:
  int n_;
  double level_, near_;
  std::vector<BoundarySample> samples_;
  std::vector<Label> labels_;
  std::vector<MaterialId> label_of_;
  std::vector<double> volumes_mm3_;
};

inline PlaneDomain plane_at(int n, double level, double near, std::vector<BoundarySample> samples = {}) {
  return {n, level, near, std::move(samples), 3};
}

// What most tests look at: a box of kSize cubes whose layers meet at z = kPlane, within kNear of which their
// surface belongs.
inline constexpr int kSize = 6;
inline constexpr double kPlane = 3;
inline constexpr double kNear = 0.6;

/// Boundary voxels on the plane between the layers, one per square.
inline std::vector<BoundarySample> samples_on_plane() {
  std::vector<BoundarySample> samples;
  for (int j = 0; j < kSize; ++j) {
    for (int i = 0; i < kSize; ++i) {
      samples.push_back({{static_cast<float>(i + 0.5), static_cast<float>(j + 0.5), float{kPlane}}, 1, 2});
    }
  }
  return samples;
}

inline PlaneDomain layers(std::vector<BoundarySample> samples = samples_on_plane()) {
  return plane_at(kSize, kPlane, kNear, std::move(samples));
}

inline double worst_angle(const MaterialMesh& mesh) {
  return worst_quality(mesh);
}

}  // namespace cbc3d::testing
