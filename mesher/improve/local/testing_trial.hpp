// The lattice mesh of an image for the operations of the improvement, and what none of them may break.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "mesher/domain/image_domain.hpp"
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
  ImageDomain domain;
  const std::vector<BoundarySample>& samples;
  std::vector<VertexId> covering;
  PatchRules rules;

  explicit Trial(const LabelImage& from)
      : image(from),
        mesh(lattice_mesh(from)),
        domain(image),
        samples(domain.samples()),
        rules{.boundaries = {domain},
              .guards = {.deviation_mm = 0.15 * diagonal(), .scale_mm = diagonal()},
              .samples = samples,
              .reach_mm = 0.9 * diagonal(),
              .patch_tets = 10000000} {
    covering = nearest_covering_vertices(samples, mesh.points, sets(), rules.reach_mm);
  }

  [[nodiscard]] double diagonal() const { return image.frame.voxel_diagonal_mm(); }
  [[nodiscard]] std::vector<MaterialSet> sets() const {
    return vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                            mesh.points.size());
  }
  void apply(const std::function<void(Patch&)>& operation, int round = 0) {
    improve_in_patches(mesh, covering, rules, round, operation);
  }

  [[nodiscard]] double worst_quality() const {
    double worst = 1;
    for (const auto& n : mesh.tets) {
      worst = std::min(
          worst, tet_quality(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]));
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

/// Expects positive and conforming tets, manifold labels, and as many covered samples as before, each within
/// the reach of its vertex, which is on its interface.
inline void expect_sound(const Trial& trial, std::size_t covered) {
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
  for (std::size_t p = 0; p < trial.samples.size(); ++p) {
    const VertexId v = trial.covering[p];
    if (v != kNoVertex) {
      ++found;
      const double distance = (trial.mesh.points[v] - trial.samples[p].centre()).norm();
      out_of_reach +=
          distance > trial.rules.reach_mm * (1 + 1e-12) || !trial.samples[p].is_on(sets[v]) ? 1 : 0;
    }
  }
  EXPECT_EQ(out_of_reach, 0U);
  EXPECT_EQ(found, covered);
}

inline std::size_t covered_count(const Trial& trial) {
  return trial.samples.size() -
         static_cast<std::size_t>(std::count(trial.covering.begin(), trial.covering.end(), kNoVertex));
}

inline const RelaxOptions kRelax = {.surface_weight = 1000, .max_step = 0.5, .skip_below_mm = 0};
inline const double kGood = quality_of_deg(35);
inline const double kGoal = quality_of_deg(20);

}  // namespace cbc3d::testing
