#include "reports/tables/microbenchmark_table.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

TEST(MicrobenchmarkTable, JoinsTheFiles) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "micro.json";
  write_text_file(file, R"({"benchmarks": [{"name": "lattice/48", "run_type": "iteration", "iterations": 7,
    "real_time": 2.5, "cpu_time": 2000.0, "time_unit": "ms", "items_per_second": 12000.0}]})");
  const auto other = folder.path() / "other.json";
  write_text_file(other, R"({"benchmarks": [{"name": "copy", "of_bandwidth": 0.425}]})");
  const Table table = microbenchmark_table(read_microbenchmarks({file, other}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].case_name, "copy");
  EXPECT_EQ(cell_text(table.rows[1].cells[5], 3), "42.50");
  EXPECT_FALSE(table.rows[0].cells[5].value.has_value());
  EXPECT_EQ(table.rows[0].cells[0].value, 2.5);
  EXPECT_EQ(table.rows[0].cells[3].value, 12000);
  EXPECT_FALSE(table.rows[0].cells[4].value.has_value());
  write_text_file(file, "[]");
  EXPECT_THROW(read_microbenchmarks({other, file}), InputError);
  EXPECT_THROW(read_microbenchmarks({folder.path() / "none"}), InputError);
}

TEST(MicrobenchmarkTable, OfARunIsThatOfItsFile) {
  const TemporaryFolder folder;
  const std::vector<JobResult> results;
  const std::vector<cases::Case> cases;
  EXPECT_TRUE(microbenchmarks_of_run({results, cases, folder.path()}).rows.empty());
  EXPECT_TRUE(microbenchmarks_of_run({results, cases}).rows.empty());
  write_text_file(folder.path() / "microbenchmarks.json", R"({"benchmarks": [{"name": "copy"}]})");
  EXPECT_EQ(microbenchmarks_of_run({results, cases, folder.path()}).rows.size(), 1U);
}

}  // namespace
}  // namespace cbc3d::reports
