#include "reports/tables/tables.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "reports/results/testing_folder.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

TEST(Tables, AreWrittenInTheWantedForms) {
  const TemporaryFolder folder;
  const std::vector<JobResult> results = decode_lines({job_line("nidus", "cgal", 1)});
  const std::vector<Table> tables = build_tables({results, {}});
  write_tables(tables, folder.path() / "tables", {"csv", "tex"});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "tables" / "time.tex"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "tables" / "time.md"));
  EXPECT_THROW(write_tables(tables, folder.path() / "tables", {"pdf"}), InputError);
}

TEST(Tables, ThoseWithoutRowsAreLeftOut) {
  const std::vector<JobResult> results = decode_lines({job_line("nidus", "cgal", 1)});
  std::vector<std::string> names;
  for (const Table& table : build_tables({results, {}})) {
    names.push_back(table.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"element_count", "element_quality", "fidelity", "time", "speed",
                                             "targets", "image_data", "input_parameters"}));
}

}  // namespace
}  // namespace cbc3d::reports
