#include "reports/gate/check.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::metric_id;

TEST(Check, FallsBeyondWhatIsAllowedInTheWorseDirectionAlone) {
  const metrics::Metric& angle = metric(metric_id("quality.min_dihedral_deg"));
  EXPECT_TRUE(check_figure("job", angle, 12, 11, 0.5).fell);
  EXPECT_FALSE(check_figure("job", angle, 12, 11.6, 0.5).fell);
  const Check better = check_figure("job", angle, 12, 13, 0.5);
  EXPECT_FALSE(better.fell);
  EXPECT_TRUE(better.better);
  EXPECT_DOUBLE_EQ(check_figure("job", angle, 12, 11, 0.5).severity, 2);
  EXPECT_EQ(check_figure("job", angle, 12, 11, 0.5).text,
            "smallest dihedral angle was 12 deg, is 11 deg (-1 deg, -8.3 %; allowed 0.5000 deg)");
}

TEST(Check, AllowsTheLargerOfBothTolerances) {
  const Json tolerances{{"angle", {{"relative", 0.1}, {"absolute", 0.5}}},
                        {"counts", {{"relative", 0.05}, {"absolute", 10}}}};
  EXPECT_DOUBLE_EQ(allowed_change(metric(metric_id("quality.min_dihedral_deg")), 20, true, tolerances), 2);
  EXPECT_DOUBLE_EQ(allowed_change(metric(metric_id("quality.min_dihedral_deg")), 2, true, tolerances), 0.5);
  EXPECT_EQ(allowed_change(metric(metric_id("counts.tets")), 1000, true, tolerances), 0);
  EXPECT_EQ(allowed_change(metric(metric_id("counts.tets")), 1000, false, tolerances), 50);
}

TEST(Check, WhatFellWhateverTheTolerancesComesFirst) {
  EXPECT_GT(fallen("job", "status", "was ok").severity, 1e9);
  EXPECT_TRUE(fallen("job", "status", "was ok").fell);
  EXPECT_EQ(with_unit(250'000'000, metric(metric_id("peak_rss_bytes"))), "250.0 MB");
}

}  // namespace
}  // namespace cbc3d::reports
