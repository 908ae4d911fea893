#include "reports/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/sweep/testing_sweep.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

TEST(Sweep, SpeedUpAndEfficiencyComeWithTheirErrors) {
  const std::vector<SweepPoint> points = sweep_points(decode_lines(sweep_lines()));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_FALSE(points[0].has_speed_up);
  EXPECT_EQ(points[0].total.seconds.size(), 5U);
  EXPECT_TRUE(points[0].total.outlier[4]);
  EXPECT_DOUBLE_EQ(points[1].speed_up.value, 4.0 / 2.5);
  EXPECT_DOUBLE_EQ(points[1].efficiency.value, 0.8);
  const double relative = points[0].total.error_s / 4.0;
  EXPECT_GT(relative, 0);
  EXPECT_NEAR(points[1].speed_up.error, 1.6 * std::hypot(relative, points[1].total.error_s / 2.5), 1e-12);
  ASSERT_EQ(points[1].stages.size(), 2U);
  EXPECT_DOUBLE_EQ(points[1].stages[1].second.median_s, 1.25);
  ASSERT_EQ(points[1].stage_speed_ups.size(), 2U);
  EXPECT_DOUBLE_EQ(points[1].stage_speed_ups[0].value, 1.6);
}

TEST(Sweep, AllSamplesAreKeptAndOutliersFlagged) {
  const Json json = to_json(sweep_points(decode_lines(sweep_lines())));
  EXPECT_EQ(json[0]["seconds"]["samples"], Json({4.0, 4.1, 3.9, 4.0, 9.0}));
  EXPECT_EQ(json[0]["seconds"]["outlier"][4], true);
  EXPECT_TRUE(json[0]["speed_up"].is_null());
  EXPECT_TRUE(json[0]["seconds"]["median_interval"].is_null());  // of five samples there is none
}

TEST(Sweep, SixSamplesHaveAnInterval) {
  std::vector<Json> lines;
  lines.reserve(6);
  for (int repeat = 0; repeat < 6; ++repeat) lines.push_back(sweep_line(1, repeat, 4 + 0.1 * repeat));
  const Json interval = to_json(sweep_points(decode_lines(lines)))[0]["seconds"]["median_interval"];
  EXPECT_GE(interval[0], 4.0);
  EXPECT_LE(interval[1], 4.5);
  EXPECT_LT(interval[0], interval[1]);
}

TEST(Sweep, AFailedSampleIsSaid) {
  std::vector<Json> lines = sweep_lines();
  lines[1]["status"] = "crashed";
  lines[1]["reason"] = "SIGSEGV";
  const std::vector<SweepPoint> points = sweep_points(decode_lines(lines));
  EXPECT_EQ(points[1].total.seconds.size(), 4U);
  EXPECT_EQ(points[1].failure, "crashed: SIGSEGV");
}

TEST(Sweep, ARunWithoutItsFileIsNone) {
  const TemporaryFolder folder;
  const std::vector<JobResult> results = decode_lines(sweep_lines());
  EXPECT_TRUE(points_of_sweep(folder.path(), results).empty());
  write_text_file(folder.path() / "sweep.json", "[]");
  EXPECT_EQ(points_of_sweep(folder.path(), results).size(), 2U);
  EXPECT_TRUE(points_of_sweep("", results).empty());
}

}  // namespace
}  // namespace cbc3d::reports
