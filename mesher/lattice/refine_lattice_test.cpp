// The rounds of the refinement and what the candidate mesh holds after them.
#include <gtest/gtest.h>

#include <vector>

#include "mesher/domain/boundary_samples.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::touching_balls;

TEST(RefineLattice, SmoothLabelsAreThoseOfTheBoundaryAtTheCentroids) {
  const LabelImage image = touching_balls();
  const ImageDomain domain(image);
  for (const bool smooth : {true, false}) {
    Lattice lattice = build_bcc_lattice(image, {3, 0.5});
    RefineOptions options;
    options.smooth_labels = smooth;
    options.one_face_rule = false;
    options.each_interface = true;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.finest_spacing_mm = 1;
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    const std::vector<Vec3> points = local_points(lattice);
    const CandidateMesh& mesh = result.mesh;
    std::size_t unlike_voxel = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Vec3 centroid;
      for (const VertexId v : mesh.tets.nodes[t]) centroid += 0.25 * points[v];
      unlike_voxel += mesh.materials[t] != image.at_local(centroid) ? 1 : 0;
      ASSERT_EQ(mesh.materials[t], smooth ? domain.material_at(centroid) : image.at_local(centroid));
    }
    EXPECT_EQ(unlike_voxel > 0, smooth);
    // The distance is held for every interface, as far as the lattice goes.
    const auto sets = vertex_materials(mesh.tets.nodes, mesh.materials, mesh.neighbours, points.size());
    EXPECT_EQ(uncovered_samples(boundary_samples(image), points, sets, options.max_distance_mm).size(),
              result.uncovered_voxels);
    EXPECT_EQ(result.uncovered_voxels, 0U);
  }
}

/// A closed box one voxel thick: with a lattice as coarse as the distance lets it be, it is full of holes.
TEST(RefineLattice, ThinPartsAreKeptVoxelByVoxel) {
  const LabelImage image = testing::make_image({20, 18, 16}, {1, 1, 1}, 1, [](const Vec3& p) {
    const bool inside = p.x > 2 && p.x < 16 && p.y > 2 && p.y < 14 && p.z > 2 && p.z < 12;
    const bool hollow = p.x > 3 && p.x < 15 && p.y > 3 && p.y < 13 && p.z > 3 && p.z < 11;
    return inside && !hollow ? 1 : 0;
  });
  const ImageDomain domain(image);
  for (const bool keep : {false, true}) {
    Lattice lattice = build_bcc_lattice(image, {10, 0.25});
    RefineOptions options;
    options.fidelity = 0.01;
    options.smooth_labels = options.each_interface = true;
    options.one_face_rule = false;
    options.keep_thin_parts = keep;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.finest_spacing_mm = 1;
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    EXPECT_EQ(result.fidelity[0].common_voxels == result.fidelity[0].image_voxels, keep);
  }
}

TEST(RefineLattice, NoTetOfALabelIsCoarserThanAsked) {
  const LabelImage image = touching_balls();
  const ImageDomain domain(image);
  Lattice lattice = build_bcc_lattice(image, {8, 0.5});
  RefineOptions options;
  options.fidelity = 0.01;
  options.coarsest_spacing_mm = 2;
  const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
  for (std::size_t t = 0; t < result.mesh.tets.size(); ++t) {
    if (result.mesh.materials[t] != kBackground) {
      ASSERT_LE(lattice.frame.spacing_mm(lattice.reds[result.mesh.tets.parent[t]].level), 2);
    }
  }
}

}  // namespace
}  // namespace cbc3d
