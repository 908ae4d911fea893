#include "metrics/shape_comparison.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

constexpr double kRadius = 9;
const Vec3 kMiddle{11.2, 11.4, 10.9};  // local, mm

// Label 1, a ball; label 2, a bar from one border of the image to the other.
LabelImage ball_and_bar() {
  LabelImage image = test::empty_image({23, 23, 40}, {1, 1, 1}, {0, 1, 2});
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    const Vec3 p = image.frame.local_centre(at[0], at[1], at[2]);
    image.voxels[v] = (p - kMiddle).norm() < kRadius ? 1 : kBackground;
  }
  test::fill_box(image, {0, 8, 28}, {22, 13, 33}, 2);
  return image;
}

// That of the ball, and of the bar as one without end.
double distance(const Vec3& p, Label label) {
  if (label == 1) return (p - kMiddle).norm() - kRadius;
  return std::max({7.5 - p.y, p.y - 13.5, 27.5 - p.z, p.z - 33.5});
}

json compare(const LabelImage& image, const LabelShapes& local_shapes) {
  EvaluateOptions options{false, false};
  options.shapes = [&](const Vec3& p, Label label) { return local_shapes(image.frame.to_local(p), label); };
  return test::judge(test::kuhn_mesh(image), image, options)["shape"];
}

TEST(ShapeComparison, AMeshOfTheVoxelsIsAsTheVoxelsAre) {
  LabelImage image = ball_and_bar();
  for (const bool left_handed : {false, true}) {
    image.frame.direction = Mat3::from_columns({.6, .8, 0}, {-.8, .6, 0}, {0, 0, left_handed ? -1.0 : 1.0});
    image.frame.origin_mm = {-40, 7, 11};
    const json shape = compare(image, distance);
    ASSERT_EQ(shape["per_label"].size(), 2U);
    const json& ball = shape["per_label"][0];
    EXPECT_EQ(ball["label"], 1);
    EXPECT_NEAR(ball["normal_deviation_deg"].get<double>(), 45, 1.5);
    EXPECT_NEAR(ball["area_excess_percent"].get<double>(), 50, 3);
    EXPECT_LT(ball["mean_distance_mm"], .5);
    EXPECT_GT(ball["max_distance_mm"], .5);
    for (const char* key :
         {"normal_deviation_deg", "area_excess_percent", "mean_distance_mm", "max_distance_mm"}) {
      const auto figure = ball[key].get<double>();
      EXPECT_NEAR(figure, ball["voxel_surface"][key].get<double>(), .02 * figure) << key;
    }
  }
}

TEST(ShapeComparison, EndsAtTheBorderDoNotCount) {
  const json shape = compare(ball_and_bar(), distance);
  const json& bar = shape["per_label"][1];
  EXPECT_EQ(bar["label"], 2);
  for (const json* side : {&bar, &bar["voxel_surface"]}) {
    EXPECT_NEAR((*side)["max_distance_mm"].get<double>(), 0, 1e-9);
    EXPECT_LT((*side)["normal_deviation_deg"], 3);  // the bar's edges have no normal
  }
}

TEST(ShapeComparison, TheWholeIsByArea) {
  const json shape = compare(ball_and_bar(), distance);
  const double ball = shape["per_label"][0]["mean_distance_mm"],
               bar = shape["per_label"][1]["mean_distance_mm"];
  EXPECT_GT(shape["mean_distance_mm"], bar);
  EXPECT_LT(shape["mean_distance_mm"], ball);
  EXPECT_EQ(shape["max_distance_mm"], shape["per_label"][0]["max_distance_mm"]);
}

TEST(ShapeComparison, LabelsOfUnknownShapeAreLeftOut) {
  const double kNone = std::numeric_limits<double>::quiet_NaN();
  const json shape = compare(ball_and_bar(),
                             [&](const Vec3& p, Label label) { return label == 2 ? kNone : distance(p, 1); });
  ASSERT_EQ(shape["per_label"].size(), 1U);
  EXPECT_EQ(shape["per_label"][0]["label"], 1);
  const json none = compare(ball_and_bar(), [&](const Vec3&, Label) { return kNone; });
  EXPECT_TRUE(none["per_label"].empty());
  EXPECT_TRUE(none["normal_deviation_deg"].is_null());
  EXPECT_TRUE(none["voxel_surface"]["area_excess_percent"].is_null());
}

TEST(ShapeComparison, IsThereOnlyWhenAskedFor) {
  const LabelImage image = test::two_boxes();
  EXPECT_FALSE(test::judge(test::kuhn_mesh(image), image, {false, false}).contains("shape"));
}

}  // namespace
}  // namespace cbc3d::metrics
