#include "reports/results/columns.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

JobResult result(const std::string& case_name, const std::string& mesher, int threads) {
  JobResult job;
  job.case_name = case_name;
  job.mesher = mesher;
  job.threads = threads;
  return job;
}

TEST(Columns, AreMeshersInTheOrderOfTheirFirstLines) {
  const std::vector<JobResult> results{result("liver", "cgal", 2), result("box", "cbc3d", 1),
                                       result("box", "cgal", 2), result("box", "cbc3d", 2)};
  const Columns columns(results);
  EXPECT_EQ(columns.names(), (std::vector<std::string>{"cgal", "cbc3d (1 thread)", "cbc3d (2 threads)"}));
  EXPECT_EQ(columns.name_of(results[3]), "cbc3d (2 threads)");
  EXPECT_EQ(columns.runs("box", "cgal"), (Runs{&results[2]}));
  EXPECT_TRUE(columns.runs("liver", "cbc3d (1 thread)").empty());
  EXPECT_EQ(case_names(results), (std::vector<std::string>{"liver", "box"}));
}

TEST(Columns, BudgetsAreRowsOfTheirOwn) {
  std::vector<JobResult> results{result("liver", "cgal", 1), result("liver", "cgal", 1)};
  results[0].budget = 25000;
  results[1].budget = 50000;
  EXPECT_EQ(case_names(results),
            (std::vector<std::string>{"liver, 25,000 elements", "liver, 50,000 elements"}));
  EXPECT_EQ(Columns(results).runs("liver, 50,000 elements", "cgal"), (Runs{&results[1]}));
  EXPECT_EQ(image_names(results), (std::vector<std::string>{"liver"}));
}

}  // namespace
}  // namespace cbc3d::reports
