#include "reports/results/front.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::Worse;

JobResult result(const std::string& mesher, std::int64_t budget, double elements, double distance_mm) {
  JobResult job;
  job.case_name = "liver";
  job.mesher = mesher;
  job.budget = budget;
  job.status = "ok";
  job.figures[metric_id("elements")] = elements;
  job.figures[metric_id("fidelity.mean_distance_mm")] = distance_mm;
  return job;
}

TEST(FrontCurve, APowerLawIsInterpolatedExactly) {
  const auto law = [](double x) { return 7 * std::pow(x, -0.6); };
  const FrontCurve curve({{4e4, law(4e4)}, {1e4, law(1e4)}, {3e5, law(3e5)}});
  for (const double x : {1e4, 2e4, 4e4, 1e5, 3e5}) EXPECT_NEAR(curve.at(x).value(), law(x), 1e-12 * law(x));
}

TEST(FrontCurve, EndsATenthBeyondItsPoints) {
  const FrontCurve curve({{100, 3}, {1000, 5}});
  EXPECT_EQ(curve.at(95), 3);
  EXPECT_EQ(curve.at(1090), 5);
  EXPECT_FALSE(curve.at(90));
  EXPECT_FALSE(curve.at(1110));
  EXPECT_FALSE(FrontCurve({}).at(1));
  EXPECT_EQ(FrontCurve({{10, 1}, {10, 3}}).at(10), 2);
}

TEST(FrontCurve, AZeroIsInterpolatedOverTheLogarithm) {
  EXPECT_NEAR(FrontCurve({{100, 0}, {10000, 8}}).at(1000).value(), 4, 1e-12);
}

TEST(TimesWorse, KnowsBothDirectionsAndZero) {
  EXPECT_EQ(times_worse(6, 2, Worse::higher), 3);
  EXPECT_EQ(times_worse(0.2, 0.8, Worse::lower), 4);
  EXPECT_EQ(times_worse(2, 6, Worse::higher), 1.0 / 3);
  EXPECT_EQ(times_worse(0, 0, Worse::higher), 1);
  EXPECT_TRUE(std::isinf(times_worse(5, 0, Worse::higher)));
  EXPECT_EQ(times_worse(0, 5, Worse::higher), 0);
  // Qualities of inverted elements are negative.
  EXPECT_TRUE(std::isinf(times_worse(-.2, .3, Worse::lower)));
  EXPECT_TRUE(std::isinf(times_worse(-.5, -.2, Worse::lower)));
  EXPECT_EQ(times_worse(.3, -.2, Worse::lower), 0);
  EXPECT_EQ(times_worse(-.2, -.5, Worse::lower), 0);
}

TEST(ComparedFigure, IsAMagnitudeWhereMoreIsWorse) {
  JobResult job;
  job.figures[metric_id("volume_error_percent")] = -2;
  job.figures[metric_id("quality.mean_ratio.p1")] = -.2;
  EXPECT_EQ(compared_figure(metric_id("volume_error_percent"))(job), 2);
  EXPECT_EQ(compared_figure(metric_id("quality.mean_ratio.p1"))(job), -.2);
}

TEST(ShortfallOf, SaysWhyThereIsNoMeshOfThatSize) {
  JobResult ok = result("a", 1000, 1000, 1), missed = ok, failed = ok;
  missed.budget_shortfall = "no fewer than 5,000 elements";
  failed.status = "crashed";
  failed.reason = "SIGSEGV";
  EXPECT_EQ(shortfall_of({}), "not run");
  EXPECT_EQ(shortfall_of({&ok}), "");
  EXPECT_EQ(shortfall_of({&missed}), "no fewer than 5,000 elements");
  EXPECT_EQ(shortfall_of({&failed}), "crashed: SIGSEGV");
}

TEST(FrontComparisons, CompareAtExactlyEqualElements) {
  // b's distance is twice a's at any number of elements; their meshes miss the budget differently.
  const auto a = [](double elements) { return 100 / std::sqrt(elements); };
  std::vector<JobResult> results;
  for (const double budget : {10000.0, 40000.0, 160000.0}) {
    const auto n = static_cast<std::int64_t>(budget);
    results.push_back(result("b", n, 0.92 * budget, 2 * a(0.92 * budget)));
    results.push_back(result("a", n, 1.08 * budget, a(1.08 * budget)));
  }
  const auto rows = front_comparisons(results, Columns(results));
  ASSERT_EQ(rows.size(), 3U);  // one figure alone is known
  EXPECT_EQ(rows[1].budget, 40000);
  EXPECT_EQ(rows[1].best, 1U);
  EXPECT_NEAR(rows[1].values[1].value(), a(40000), 1e-9);
  EXPECT_NEAR(rows[1].lead, 2, 1e-9);
}

TEST(FrontComparisons, AMesherWithoutSuchAMeshHasNoValue) {
  std::vector<JobResult> results{result("a", 1000, 1000, 1), result("b", 1000, 5000, 9),
                                 result("c", 1000, 1000, 0.1)};
  results[2].status = "failed";
  const auto rows = front_comparisons(results, Columns(results));
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].best, 0U);
  EXPECT_FALSE(rows[0].values[1]);
  EXPECT_FALSE(rows[0].values[2]);
  EXPECT_EQ(rows[0].lead, 1);
}

}  // namespace
}  // namespace cbc3d::reports
