// The deformation as a whole: the quality it keeps, and how it ends.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

using testing::paper_mesh;

/// The smallest dihedral angle of the tets, degrees, and the smallest scaled Jacobian of the other cells.
std::pair<double, double> worst(const MaterialMesh& mesh) {
  std::pair<double, double> smallest = {180, 1};
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    std::vector<Vec3> p;
    for (const VertexId v : mesh.nodes_of(c)) {
      p.push_back(mesh.points[v]);
    }
    if (p.size() == 4) {
      smallest.first = std::min(smallest.first, min_dihedral_deg(p[0], p[1], p[2], p[3]));
    } else {
      smallest.second =
          std::min(smallest.second, p.size() == 5 ? scaled_jacobian_pyramid(std::span<const Vec3, 5>(p))
                                                  : scaled_jacobian_hex(std::span<const Vec3, 8>(p)));
    }
  }
  return smallest;
}

TEST(DeformMesh, NoCellFallsBelowTheMinimumWhateverTheImage) {
  for (const bool mixed : {false, true}) {
    for (const std::uint32_t seed : {3U, 4U}) {
      for (const OnFailure on_failure : {OnFailure::stop, OnFailure::recover}) {
        LabelImage image = testing::noise_image(16, 0.3, seed);
        MaterialMesh mesh = testing::paper_mesh_of_cleaned(
            image, {.spacing_mm = 4, .mixed = mixed, .clean = {.manifold_voxels = false}});
        DeformOptions options;
        options.iterations = 20;
        options.on_failure = on_failure;
        deform_mesh(mesh, image, options, [](int) {});
        ASSERT_GT(mesh.cell_count(), 0U);
        EXPECT_GE(worst(mesh).first, 5 - 1e-6);
        EXPECT_GE(worst(mesh).second, 0.2 - 1e-9);
        EXPECT_LT(worst(mesh).first, 29) << "the mesh has moved";
      }
    }
  }
}

TEST(DeformMesh, StopsAsThePaperDoesOrGoesOn) {
  const LabelImage image = testing::noise_image(16, 0.4, 9);
  const MaterialMesh start = paper_mesh(image, {.spacing_mm = 4});
  DeformOptions options;
  options.iterations = 6;
  options.displacement.along_normal = false;
  options.on_failure = OnFailure::stop;
  MaterialMesh stopped = start;
  const DeformReport first = deform_mesh(stopped, image, options, [](int) {});
  ASSERT_TRUE(first.stopped_early);
  EXPECT_LT(first.iterations.size(), 6U);
  EXPECT_EQ(first.iterations.back().attempts, 3);
  DeformOptions shorter = options;
  shorter.iterations = static_cast<int>(first.iterations.size()) - 1;
  MaterialMesh before = start;
  deform_mesh(before, image, shorter, [](int) {});
  EXPECT_EQ(stopped.points, before.points) << "the failed iteration is taken back";
  options.on_failure = OnFailure::recover;
  MaterialMesh recovered = start;
  const DeformReport second = deform_mesh(recovered, image, options, [](int) {});
  EXPECT_FALSE(second.stopped_early);
  EXPECT_EQ(second.iterations.size(), 6U);
  EXPECT_GT(second.iterations[0].held_vertices, 0U);
}

TEST(DeformMesh, SameBytesAtOneAndTwoThreads) {
  const LabelImage image = testing::ball_image(36, 1.1, 14, 7);
  const MaterialMesh start = paper_mesh(image, {.spacing_mm = 7, .mixed = true});
  ASSERT_GT(start.hexes.size(), 0U);
  std::vector<MaterialMesh> results;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    results.push_back(start);
    DeformOptions options;
    options.iterations = 6;
    deform_mesh(results.back(), image, options, [](int) {});
  }
  EXPECT_EQ(results[0].points, results[1].points);
}

TEST(DeformMesh, TellsWhereItsTimeWent) {
  const LabelImage image = testing::ball_image(24, 1, 8);
  MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 4});
  const DeformReport report = deform_mesh(mesh, image, {}, [](int) {});
  std::set<std::string> parts;
  for (const auto& [name, seconds] : report.part_seconds) {
    parts.insert(name);
    EXPECT_GE(seconds, 0);
  }
  EXPECT_EQ(parts,
            (std::set<std::string>{"extraction", "displacements", "assembly", "solve", "quality_control"}));
}

}  // namespace
}  // namespace cbc3d
