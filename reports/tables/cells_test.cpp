#include "reports/tables/cells.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Cell cell(std::vector<Json> lines, metrics::MetricId id) {
  const std::vector<JobResult> results = decode_lines(std::move(lines));
  return cell_of(Columns(results).runs("nidus", "cgal"), id);
}

constexpr metrics::MetricId kTets = metrics::metric_id("counts.tets");
constexpr metrics::MetricId kTime = metrics::metric_id("time_s.mesh");

TEST(Cells, ARepeatThatFailedIsSaidBesideTheFigure) {
  const Cell some = cell({job_line("nidus", "cgal", 30), crashed_line("nidus", "cgal", "oops", 1)}, kTets);
  EXPECT_EQ(some.value, 30);
  EXPECT_EQ(some.runs, 1);
  EXPECT_EQ(some.reason, "1 of 2 runs crashed: oops");
  const Cell none = cell({crashed_line("nidus", "cgal", "oops")}, kTets);
  EXPECT_FALSE(none.value.has_value());
  EXPECT_EQ(none.reason, "crashed: oops");
  EXPECT_EQ(cell({job_line("liver", "cgal", 30)}, kTets).reason, "not run");
}

TEST(Cells, TheTimeOfAWholeProcessSaysSo) {
  Json line = timed_line("nidus", "cgal", 30, 2);
  EXPECT_EQ(cell({line}, kTime).reason, "");
  line["time_s"]["includes_files"] = true;
  EXPECT_EQ(cell({line}, kTime).reason, "whole process, reading and writing files included");
  EXPECT_EQ(cell({line}, metrics::metric_id("time_s.cpu")).reason, "");
  EXPECT_EQ(cell({line, crashed_line("nidus", "cgal", "oops", 1)}, kTime).reason,
            "1 of 2 runs crashed: oops");
}

}  // namespace
}  // namespace cbc3d::reports
