#include "metrics/evaluate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

void expect_near(const json& a, const json& b, double tolerance, const std::string& where = "") {
  ASSERT_EQ(a.is_number(), b.is_number()) << where;
  if (a.is_number()) {
    // Where pieces are cut follows rounding, so that upper bounds agree to the tolerance only.
    const bool upper = where.find("bounds_mm/1") != std::string::npos;
    EXPECT_NEAR(a.get<double>(), b.get<double>(), upper ? kRelativeTolerance * .8 : tolerance) << where;
  } else if (a.is_structured()) {
    ASSERT_EQ(a.size(), b.size()) << where;
    for (const auto& [key, value] : a.items()) {
      expect_near(value, a.is_object() ? b.at(key) : b.at(std::stoul(key)), tolerance,
                  std::string(where).append("/").append(key));
    }
  } else {
    EXPECT_EQ(a, b) << where;
  }
}

TEST(Evaluate, TheVoxelsThemselvesAreAPerfectMesh) {
  const LabelImage image = test::two_boxes();
  const json result = test::judge(test::kuhn_mesh(image), image);
  EXPECT_EQ(result.size(), 7U);
  // The helper lists every corner of the voxel grid: 10 * 9 * 8, of which the boxes have 6 * 5 * 4.
  ASSERT_EQ(result["faults"].size(), 1U);
  EXPECT_EQ(result["faults"][0].get<std::string>().rfind("600 vertices of no cell, first vertex 0 at (", 0),
            0U)
      << result["faults"];
  EXPECT_EQ(result["counts"]["tets"], 6 * (36 + 24));
  EXPECT_EQ(result["quality"]["inverted"], 0);
  const json& fidelity = result["fidelity"];
  EXPECT_EQ(fidelity["dice_min"], 1.0);
  EXPECT_TRUE(fidelity["missing_labels"].empty());
  EXPECT_TRUE(fidelity["unknown_labels"].empty());
  EXPECT_NEAR(fidelity["surface_hausdorff_mm"].get<double>(), 0, 1e-12);
  // Every centre lies half a voxel diagonal from a corner of its voxel, and every corner vertex likewise.
  EXPECT_NEAR(fidelity["hausdorff_mm"].get<double>(), std::sqrt(1 + .25 + 4) / 2, 1e-12);
  ASSERT_EQ(fidelity["per_label"].size(), 2U);
  EXPECT_EQ(fidelity["per_label"][1]["label"], 7);
  EXPECT_EQ(fidelity["per_label"][1]["voxels"], 24);
  EXPECT_NEAR(fidelity["per_label"][1]["mesh_volume_mm3"].get<double>(), 24, 1e-12);
  for (const json& row : fidelity["per_label"])
    EXPECT_NEAR(row["volume_error_percent"].get<double>(), 0, 1e-12);
  EXPECT_EQ(result["topology"]["conforming"], true);
  EXPECT_EQ(result["topology"]["non_manifold_edges"], 0);
  EXPECT_EQ(result["topology"]["non_manifold_vertices"], 0);
  EXPECT_EQ(result["topology"]["components"], 2);
}

TEST(Evaluate, ShiftedBoxHasAKnownHausdorffDistance) {
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  for (Vec3& p : mesh.points) p.x += 10;  // whole voxels, beyond the image
  const json fidelity = test::judge(mesh, image)["fidelity"];
  // From the lowest layer of centres to the lowest layer of vertices: 10 less half a voxel along x.
  EXPECT_NEAR(fidelity["hausdorff_mm"].get<double>(), std::sqrt(10.5 * 10.5 + .0625 + 1), 1e-9);
  EXPECT_EQ(fidelity["dice_min"], 0.0);
  EXPECT_NEAR(fidelity["surface_hausdorff_mm"].get<double>(), 10, 1e-9);
}

TEST(Evaluate, MissingAndUnknownLabels) {
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  for (Label& label : mesh.tets.labels) label = label == 7 ? 5 : label;
  const json fidelity = test::judge(mesh, image)["fidelity"];
  EXPECT_EQ(fidelity["missing_labels"], json::array({7}));
  EXPECT_EQ(fidelity["unknown_labels"], json::array({5}));
  const json& row = fidelity["per_label"][1];
  EXPECT_TRUE(row["hausdorff_mm"].is_null());
  EXPECT_TRUE(row["mean_distance_mm"].is_null());
  EXPECT_EQ(row["dice"], 0.0);
  EXPECT_EQ(row["volume_error_percent"], -100.0);
  EXPECT_EQ(fidelity["hausdorff_mm"], fidelity["per_label"][0]["hausdorff_mm"]);
  EXPECT_EQ(fidelity["dice_min"], 0.0);
}

TEST(Evaluate, EmptyMeshHasNullsOnly) {
  const json result = test::judge(Mesh{}, test::two_boxes());
  EXPECT_TRUE(result["quality"]["min_dihedral_deg"].is_null());
  EXPECT_TRUE(result["quality"]["min_scaled_jacobian"].is_null());
  EXPECT_TRUE(result["fidelity"]["hausdorff_mm"].is_null());
  EXPECT_EQ(result["fidelity"]["missing_labels"], json::array({1, 7}));
  EXPECT_EQ(result["topology"]["components"], 0);
}

TEST(Evaluate, BrokenMeshesAreRefused) {
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  mesh.points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(test::judge(mesh, image), InputError);
  mesh = test::kuhn_mesh(image);
  mesh.tets.nodes[2][1] = static_cast<VertexId>(mesh.points.size());
  EXPECT_THROW(test::judge(mesh, image), InputError);
}

// A body with a bumpy boundary, meshed by its own voxels and then shaken, so that no figure is trivial.
LabelImage bumpy_image() {
  LabelImage image = test::empty_image({14, 12, 11}, {.8, 1.1, 1.7}, {0, 2, 5});
  std::mt19937 random(11);
  for (int k = 1; k < 10; ++k) {
    for (int j = 1; j < 11; ++j) {
      for (int i = 1; i < 13; ++i) {
        if (random() % 9 != 0)
          image.voxels[image.frame.offset(i, j, k)] = static_cast<MaterialId>(i < 7 ? 1 : 2);
      }
    }
  }
  return image;
}

// Shaken in the image's own frame, so that the same mesh arises in every frame.
Mesh shaken_mesh(const LabelImage& image) {
  Mesh mesh = test::kuhn_mesh(image);
  std::mt19937 random(12);
  const auto shift = [&random] { return .2 * (static_cast<double>(random()) / 4294967296.0 - .5); };
  for (Vec3& p : mesh.points) {
    const Vec3 by{shift(), shift(), shift()};
    p += image.frame.direction * by;
  }
  return mesh;
}

// Brings the places that are named (at_mm) back to the image's local frame.
void bring_home(json& figures, const ImageFrame& frame) {
  for (auto& [key, value] : figures.items()) {
    if (key.ends_with("at_mm") && value.is_array()) {
      const Vec3 local =
          frame.to_local({value[0].get<double>(), value[1].get<double>(), value[2].get<double>()});
      value = {local.x, local.y, local.z};
    } else if (value.is_structured()) {
      bring_home(value, frame);
    }
  }
}

// Without the faults, which name places in words.
json figures(const LabelImage& image) {
  json result = test::judge(shaken_mesh(image), image);
  result.erase("faults");
  bring_home(result, image.frame);
  return result;
}

TEST(Evaluate, FrameDoesNotMatter) {
  LabelImage image = bumpy_image();
  const json plain = figures(image);
  const double c = std::cos(.3), s = std::sin(.3);
  image.frame.origin_mm = {-120, 35, 80};
  image.frame.direction = Mat3::from_columns({c, s, 0}, {-s, c, 0}, {0, 0, 1});
  expect_near(plain, figures(image), 1e-8);
  image.frame.direction = Mat3::from_columns({c, s, 0}, {-s, c, 0}, {0, 0, -1});
  expect_near(plain, figures(image), 1e-8);
}

TEST(Evaluate, SameBytesAtAnyThreadCount) {
  const LabelImage image = bumpy_image();
  const Mesh mesh = shaken_mesh(image);
  set_thread_count(1);
  const std::string one = test::judge(mesh, image).dump();
  for (const int threads : {2, 3}) {
    set_thread_count(threads);
    EXPECT_EQ(test::judge(mesh, image).dump(), one);
  }
  set_thread_count(0);
  EXPECT_EQ(one.find("NaN"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::metrics
