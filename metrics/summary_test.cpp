#include "metrics/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

// Labels 3 and 9 side by side, cut at `cut` along x, 12 voxels long in all; labels 5 and 6 apart, of 60 and
// 48 voxels.
LabelImage cut_box(int cut) {
  LabelImage image = test::empty_image({24, 14, 14}, {1.0, 0.5, 2.0}, {0, 3, 5, 6, 9});
  test::fill_box(image, {2, 2, 2}, {cut - 1, 11, 11}, 1);
  test::fill_box(image, {cut, 2, 2}, {13, 11, 11}, 4);
  test::fill_box(image, {16, 2, 2}, {18, 6, 5}, 2);
  test::fill_box(image, {16, 2, 8}, {18, 5, 11}, 3);
  return image;
}

json look_at(const Mesh& mesh, const LabelImage& image) {
  return test::judge(mesh, image, {false, false})["summary"];
}

TEST(Summary, OfTheVoxelsThemselves) {
  const LabelImage image = cut_box(8);
  const json look = look_at(test::kuhn_mesh(image), image);
  const double diagonal = std::sqrt(1 + .25 + 4);
  EXPECT_EQ(look["elements"], 6 * (1200 + 60 + 48));
  EXPECT_NEAR(look["voxel_diagonal_mm"].get<double>(), diagonal, 1e-12);
  for (const char* name : {"hausdorff", "image_to_mesh", "mesh_to_image", "union_hausdorff",
                           "union_image_to_mesh", "union_mesh_to_image"}) {
    EXPECT_NEAR(look[name + std::string("_diagonals")].get<double>(), .5, 1e-12) << name;
    EXPECT_NEAR(look[name + std::string("_mm")].get<double>(), .5 * diagonal, 1e-12) << name;
  }
  EXPECT_NEAR(look["volume_error_percent"].get<double>(), 0, 1e-9);
  for (const char* list :
       {"missing_labels", "inverted_labels", "non_manifold_labels", "self_intersection_labels"})
    EXPECT_EQ(look[list], json::array()) << list;
  for (const char* count : {"inverted", "non_manifold_edges", "non_manifold_vertices", "self_intersections"})
    EXPECT_EQ(look[count], 0) << count;
  EXPECT_EQ(look["dice_min"], 1.0);
  EXPECT_EQ(look["dice_label"], 3);
  EXPECT_EQ(look["topology_differences"], 0);
  EXPECT_EQ(look["topology_difference_labels"], json::array());
  EXPECT_GT(look["min_dihedral_deg"], 0);
  EXPECT_EQ(look["min_dihedral_label"], 3);
}

TEST(Summary, AnInterfaceOutOfPlaceIsNoFaultOfTheUnion) {
  const json look = look_at(test::kuhn_mesh(cut_box(10)), cut_box(7));
  EXPECT_NEAR(look["union_hausdorff_diagonals"].get<double>(), .5, 1e-12);
  // The interface has moved by 3 mm, from half a voxel beside the centres on either side.
  const auto off = [](double x) { return std::sqrt(x * x + .0625 + 1); };
  EXPECT_NEAR(look["hausdorff_mm"].get<double>(), off(3.5), 1e-9);
  EXPECT_EQ(look["hausdorff_label"], 3);
  EXPECT_NEAR(look["mesh_to_image_mm"].get<double>(), off(3.5), 1e-9);
  EXPECT_EQ(look["mesh_to_image_label"], 3);
  EXPECT_NEAR(look["image_to_mesh_mm"].get<double>(), off(2.5), 1e-9);
  EXPECT_EQ(look["image_to_mesh_label"], 9);
  // Label 3 has grown by 60 %, but from 500 voxels; 9 has lost three of seven layers.
  EXPECT_NEAR(look["volume_error_percent"].get<double>(), -300. / 7, 1e-9);
  EXPECT_EQ(look["volume_error_label"], 9);
  // Of eleven layers that either has, 9 has four in common; 3 has five of thirteen.
  EXPECT_NEAR(look["dice_min"].get<double>(), 2 * 4 / 11., 1e-12);
  EXPECT_EQ(look["dice_label"], 9);
  const json& worst = look["worst_labels"];
  ASSERT_EQ(worst.size(), kWorstLabels);
  EXPECT_EQ(worst[0]["label"], 9);
  EXPECT_EQ(worst[0]["voxels"], 700);
  EXPECT_NEAR(worst[0]["volume_error_percent"].get<double>(), -300. / 7, 1e-9);
  EXPECT_EQ(worst[1]["label"], 3);
  EXPECT_NEAR(worst[1]["dice"].get<double>(), 2 * 5 / 13., 1e-12);
  EXPECT_NEAR(worst[1]["volume_error_percent"].get<double>(), 60, 1e-9);
  EXPECT_EQ(worst[2]["label"], 5);
}

TEST(Summary, OnlyLabelsAboveFiftyVoxelsMustBeThere) {
  const LabelImage image = cut_box(8);
  LabelImage without = image;
  test::fill_box(without, {16, 2, 2}, {18, 11, 11}, kBackground);
  const json result = test::judge(test::kuhn_mesh(without), image, {false, false});
  EXPECT_EQ(result["summary"]["missing_labels"], json::array({5}));
  EXPECT_EQ(result["fidelity"]["missing_labels"], json::array({5, 6}));
  EXPECT_EQ(result["summary"]["dice_min"], 0.0);
  EXPECT_EQ(result["summary"]["topology_differences"], 2);
  EXPECT_EQ(result["summary"]["topology_difference_labels"], json::array({5, 6}));
}

TEST(Summary, NamesTheLabelsWithFaults) {
  const LabelImage image = cut_box(8);
  Mesh mesh = test::kuhn_mesh(image);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.tets.labels[t] == 6) {
      std::swap(mesh.tets.nodes[t][0], mesh.tets.nodes[t][1]);
      break;
    }
  }
  const json look = look_at(mesh, image);
  EXPECT_EQ(look["inverted"], 1);
  EXPECT_EQ(look["inverted_labels"], json::array({6}));
}

TEST(Summary, OfNoMesh) {
  const json look = look_at({}, cut_box(8));
  EXPECT_EQ(look["elements"], 0);
  for (const char* key : {"min_dihedral_deg", "min_dihedral_label", "hausdorff_mm", "hausdorff_label",
                          "union_hausdorff_diagonals"})
    EXPECT_TRUE(look[key].is_null()) << key;
  EXPECT_EQ(look["volume_error_percent"], -100.0);
  EXPECT_EQ(look["missing_labels"], json::array({3, 5, 9}));
}

}  // namespace
}  // namespace cbc3d::metrics
