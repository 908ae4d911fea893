// The lattice mesh of an image for the operations of the improvement, and what none of them may break.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "mesher/domain/image_boundary.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/lattice/testing_lattice_mesh.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d::testing {

/// The lattice mesh of an image as one patch, with all that the operations ask for.
struct Trial {
  LabelImage image;
  MaterialMesh mesh;
  std::vector<InterfacePoint> points;
  std::vector<VertexId> hosts;
  ImageBoundary boundary;
  PatchRules rules;

  explicit Trial(const LabelImage& from)
      : image(from),
        mesh(lattice_mesh(from)),
        points(interface_points(image)),
        boundary(image, {}),
        rules{boundary, {0.15 * diagonal(), diagonal()}, points, 0.9 * diagonal(), 10000000} {
    hosts = nearest_hosts(points, mesh.points, sets(), rules.reach_mm);
  }

  [[nodiscard]] double diagonal() const { return image.frame.voxel_diagonal_mm(); }
  [[nodiscard]] std::vector<MaterialSet> sets() const {
    return vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                            mesh.points.size());
  }
  void apply(const std::function<void(Patch&)>& operation, int round = 0) {
    improve_in_patches(mesh, hosts, rules, round, operation);
  }

  [[nodiscard]] double worst_sine_squared() const {
    double worst = 1;
    for (const auto& n : mesh.tets) {
      worst = std::min(worst, min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]],
                                               mesh.points[n[3]]));
    }
    return worst;
  }
  [[nodiscard]] std::vector<double> volumes() const {
    std::vector<double> sums(image.material_count(), 0.0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto& n = mesh.tets[t];
      sums[mesh.materials[t]] +=
          six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
    }
    return sums;
  }
  [[nodiscard]] std::vector<long> characteristics() const {
    std::vector<long> chi;
    for (MaterialId m = 1, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
      chi.push_back(euler_characteristic(surface_of_label(mesh.tets, mesh.materials, m)));
    }
    return chi;
  }
};

/// Positive, conforming, every label a manifold, hosts within reach and on their interface, none of them
/// lost.
inline void expect_sound(const Trial& trial, std::size_t hosted) {
  EXPECT_EQ(inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
  EXPECT_EQ(crowded_faces(trial.mesh.tets), 0U);
  for (MaterialId m = 1, end = static_cast<MaterialId>(trial.image.material_count()); m < end; ++m) {
    const auto faults = faults_of_surface(surface_of_label(trial.mesh.tets, trial.mesh.materials, m));
    EXPECT_EQ(faults.edges, 0U) << "label " << m;
    EXPECT_EQ(faults.vertices, 0U) << "label " << m;
  }
  const auto sets = trial.sets();
  std::size_t found = 0;
  std::size_t out_of_reach = 0;
  for (std::size_t p = 0; p < trial.points.size(); ++p) {
    const VertexId host = trial.hosts[p];
    if (host != kNoVertex) {
      ++found;
      const double distance = (trial.mesh.points[host] - trial.points[p].centre()).norm();
      out_of_reach +=
          distance > trial.rules.reach_mm * (1 + 1e-12) || !trial.points[p].is_on(sets[host]) ? 1 : 0;
    }
  }
  EXPECT_EQ(out_of_reach, 0U);
  EXPECT_EQ(found, hosted);
}

inline std::size_t hosted(const Trial& trial) {
  return trial.points.size() -
         static_cast<std::size_t>(std::count(trial.hosts.begin(), trial.hosts.end(), kNoVertex));
}

inline const RelaxOptions kRelax = {1000, 0.5, 0};
inline const double kGood = sine_squared_of_deg(35);
inline const double kGoal = sine_squared_of_deg(20);

}  // namespace cbc3d::testing
