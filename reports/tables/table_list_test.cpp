#include "reports/tables/table_list.hpp"

#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "metrics/catalog.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

/// The names of all tables of a run of a mixed mesh on a shape that is known, solved on.
std::set<std::string> all_names() {
  Json line = job_line("ball", "cbc3d-mixed", 1);
  line["counts"]["hexes"] = 1;
  line["shape"]["normal_deviation_deg"] = 1.0;
  line["solver"]["poisson_p1"]["h1_relative"] = 0.1;
  const std::vector<JobResult> results = decode_lines({line});
  std::set<std::string> names;
  for (const TableBuilder& build : table_list()) {
    const Table table = build({results, {}});
    EXPECT_TRUE(table.name.empty() || names.insert(table.name).second) << table.name << " stands twice";
  }
  return names;
}

TEST(TableList, EveryTableThatTheCatalogNamesIsThere) {
  const std::set<std::string> names = all_names();
  for (const metrics::Metric& metric : metrics::kCatalog) {
    std::istringstream tables{std::string(metric.tables)};
    for (std::string name; tables >> name;) {
      EXPECT_TRUE(names.contains(name)) << metric.key << " names the table " << name;
    }
  }
}

TEST(TableList, HasTheTablesThatOthersRelyOn) {
  const std::set<std::string> names = all_names();
  for (const char* name : {"element_count", "element_quality", "fidelity", "time", "vertices"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
}

}  // namespace
}  // namespace cbc3d::reports
