#include "reports/results/run_values.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

constexpr metrics::MetricId kMemory = metrics::metric_id("peak_rss_bytes");

JobResult result(const std::string& status, double bytes) {
  JobResult job;
  job.status = status;
  job.figures[kMemory] = bytes;
  return job;
}

TEST(RunValues, AreThoseOfGoodRunsAsTheyAreShown) {
  const JobResult bad = result("crashed", 9e6), a = result("ok", 3e6), b = result("ok", 1e6);
  const Runs runs{&bad, &a, &b};
  EXPECT_EQ(values_of(runs, shown_figure(kMemory)), (std::vector<double>{3, 1}));  // megabytes
  EXPECT_EQ(median_of(runs, shown_figure(kMemory)), 2);
  EXPECT_EQ(first_good(runs), &a);
  EXPECT_FALSE(median_of({&bad}, shown_figure(kMemory)).has_value());
  EXPECT_EQ(first_good({&bad}), nullptr);
  EXPECT_FALSE(median_of(runs, shown_figure(metrics::metric_id("threads"))).has_value());
}

}  // namespace
}  // namespace cbc3d::reports
