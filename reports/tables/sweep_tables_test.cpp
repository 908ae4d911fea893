#include "reports/tables/sweep_tables.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/sweep/testing_sweep.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

TEST(SweepTables, ShowMediansWithTheirErrorsAndOutliers) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "sweep.json", "[]");
  const std::vector<JobResult> results = decode_lines(sweep_lines());
  const std::vector<cases::Case> cases;
  const std::string text = to_markdown(sweep_table({results, cases, folder.path()}));
  EXPECT_NE(text.find("9.000 (#5)"), std::string::npos) << text;
  EXPECT_NE(text.find("1.60 (faster, A 0.00)"), std::string::npos) << text;  // five samples have no interval
  EXPECT_NE(text.find("too few samples"), std::string::npos) << text;
  const Table stages = sweep_stage_table({results, cases, folder.path()});
  EXPECT_EQ(text_in(stages, "box, cbc3d, 2 threads", "deformation", 0), "1.2500");
  EXPECT_EQ(text_in(stages, "box, cbc3d, 2 threads", "deformation", 2), "50.0");
}

TEST(SweepTables, TenSamplesHaveIntervals) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "sweep.json", "[]");
  std::vector<Json> lines;
  for (int repeat = 0; repeat < 10; ++repeat) {
    lines.push_back(sweep_line(1, repeat, 4 + 0.01 * repeat));
    lines.push_back(sweep_line(2, repeat, 4 + 0.01 * (repeat % 7)));
  }
  const std::vector<JobResult> results = decode_lines(lines);
  const std::vector<cases::Case> cases;
  const std::string text = to_markdown(sweep_table({results, cases, folder.path()}));
  EXPECT_NE(text.find("1.01 (1.00-1.01; not told apart, A 0."), std::string::npos)
      << text;  // 4.045 s over 4.02 s
}

TEST(SweepTables, ARunThatIsNoSweepHasNone) {
  EXPECT_TRUE(table_of(sweep_table, sweep_lines()).rows.empty());
  EXPECT_TRUE(table_of(sweep_stage_table, sweep_lines()).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
