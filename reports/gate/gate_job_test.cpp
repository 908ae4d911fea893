#include "reports/gate/gate_job.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

using metrics::metric_id;

Json gate_line(int repeat, double cpu_s, double reference_s, int tets) {
  Json result = empty_result();
  result["case"] = "box";
  result["mesher"] = "cgal";
  result["threads"] = 1;
  result["repeat"] = repeat;
  result["status"] = "ok";
  result["counts"]["tets"] = tets;
  result["quality"]["min_dihedral_deg"] = 10.0 + repeat;
  result["fidelity"]["missing_labels"] = {repeat};
  result["time_s"]["cpu"] = cpu_s;
  result["time_s"]["reference_cpu"] = reference_s;
  result["peak_rss_bytes"] = 1000 * (3 - repeat);
  return result;
}

TEST(GateJob, RepeatsAreOne) {
  const std::vector<GateJob> jobs =
      gate_jobs(decode_lines({gate_line(0, 3, 0.5, 7), gate_line(1, 2, 1, 7), gate_line(2, 4, 2, 7)}));
  ASSERT_EQ(jobs.size(), 1U);
  EXPECT_EQ(jobs[0].name, "box, cgal, 1 thread");
  EXPECT_EQ(jobs[0].figures[metric_id("quality.min_dihedral_deg")], 11);  // the median
  EXPECT_EQ(jobs[0].figures[metric_id("peak_rss_bytes")], 1000);          // the least
  EXPECT_EQ(jobs[0].figures[metric_id("time_ratio")], 4);                 // the least over the least
  EXPECT_EQ(jobs[0].missing_labels, (std::vector<long>{0, 1, 2}));
  EXPECT_EQ(jobs[0].first_difference, "");
  EXPECT_EQ(jobs[0].failure, "");
}

TEST(GateJob, DifferentRepeatsAndFailuresAreSaid) {
  EXPECT_EQ(gate_jobs(decode_lines({gate_line(0, 1, 1, 7), gate_line(1, 1, 1, 8)}))[0].first_difference,
            "counts.tets is 7 in repeat 0 and 8 in repeat 1");
  Json bad = gate_line(1, 1, 1, 7);
  bad["status"] = "timeout";
  bad["reason"] = "not done after 5 s";
  EXPECT_EQ(gate_jobs(decode_lines({gate_line(0, 1, 1, 7), bad}))[0].failure, "timeout: not done after 5 s");
}

TEST(GateJob, GatedMetricsAreFoundByTheirKeys) {
  EXPECT_EQ(find_gated_metric("volume_error_percent"), metric_id("volume_error_percent"));
  EXPECT_FALSE(find_gated_metric("summary.elements").has_value());  // it is not gated
  EXPECT_FALSE(find_gated_metric("colour").has_value());
  EXPECT_EQ(gate_job_name("liver", "cbc3d", 2), "liver, cbc3d, 2 threads");
}

}  // namespace
}  // namespace cbc3d::reports
