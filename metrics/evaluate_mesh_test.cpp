#include "metrics/evaluate_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/core/error.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

TEST(EvaluateMesh, FiguresOfAPerfectMesh) {
  const LabelImage image = test::two_boxes();
  const MeshEvaluation found = evaluate_mesh(test::kuhn_mesh(image), image);
  EXPECT_EQ(found.tets, 6U * (36 + 24));
  EXPECT_EQ(found.vertices, 10U * 9 * 8);
  EXPECT_EQ(found.pyramids + found.wedges + found.hexes + found.inverted, 0U);
  EXPECT_GT(found.min_dihedral_deg.value(), 0);
  EXPECT_GT(found.min_scaled_jacobian.value(), 0);
  // Every centre lies half a voxel diagonal from a corner of its voxel.
  EXPECT_NEAR(found.hausdorff_mm.value(), std::sqrt(1 + .25 + 4) / 2, 1e-12);
  EXPECT_NEAR(found.surface_hausdorff_mm.value(), 0, 1e-12);
  EXPECT_EQ(found.dice_min.value(), 1);
  EXPECT_NEAR(found.volume_error_percent_max.value(), 0, 1e-12);
  EXPECT_TRUE(found.conforming);
  EXPECT_EQ(found.components, 2U);
  EXPECT_EQ(found.self_intersections + found.non_manifold_edges + found.non_manifold_vertices, 0U);
  EXPECT_EQ(found.faults.size(), 1U);  // the vertices of no cell
}

TEST(EvaluateMesh, TheTextHasTheFigures) {
  const LabelImage image = test::two_boxes();
  const Mesh mesh = test::kuhn_mesh(image);
  const nlohmann::json figures = nlohmann::json::parse(evaluate_mesh(mesh, image).json);
  EXPECT_EQ(figures, test::judge(mesh, image));
}

TEST(EvaluateMesh, FiguresThatAMeshCannotHaveAreEmpty) {
  const LabelImage image = test::two_boxes();
  const MeshEvaluation found = evaluate_mesh({}, image);
  EXPECT_EQ(found.tets, 0U);
  EXPECT_FALSE(found.min_dihedral_deg.has_value());
  EXPECT_FALSE(found.hausdorff_mm.has_value());
  EXPECT_EQ(found.missing_labels, (std::vector<Label>{1, 7}));
}

TEST(EvaluateMesh, RefusesCellsWithoutVerticesAndCanBeCancelled) {
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  EXPECT_THROW(evaluate_mesh(mesh, image, {}, [](std::string_view, double) { return false; }), Cancelled);
  mesh.tets.nodes[0][0] = 1U << 30U;
  EXPECT_THROW(evaluate_mesh(mesh, image), InputError);
}

}  // namespace
}  // namespace cbc3d::metrics
