#include "reports/tables/tables.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

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
  std::set<std::string> names;
  for (const Table& table : build_tables({results, {}})) {
    EXPECT_FALSE(table.rows.empty()) << table.name;
    names.insert(table.name);
  }
  for (const char* name : {"element_count", "element_quality", "shape", "surface", "fidelity", "time",
                           "speed", "targets", "image_data", "input_parameters"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  for (const char* name :
       {"vertices", "scaling", "solver", "smoothness", "deformation_patterns", "sweep", "microbenchmarks"}) {
    EXPECT_FALSE(names.contains(name)) << name;
  }
}

}  // namespace
}  // namespace cbc3d::reports
