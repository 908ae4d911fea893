#include "reports/tables/deformation_pattern_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Json deformed(const std::string& case_name, const std::string& iterations, double distance) {
  Json line = timed_line(case_name, "cbc3d-paper", 1, 2);
  line["time_s"]["stages"] = {{"deformation", 1.0}};
  line["parameters"] = {{"iterations", iterations}};
  line["fidelity"]["hausdorff_mm"] = distance;
  line["mesher_report"]["deformation"] = {{"targets", 2801}};
  return line;
}

TEST(DeformationPatternTable, StandsBesideThePapers) {
  cases::Case subject;
  subject.name = "nidus-vertex";
  subject.deformation_pattern = {"vertex", "as it is", "nidus-lattice"};
  const std::vector<Json> lines{deformed("nidus-lattice", "0", 1.8), deformed("nidus-vertex", "10", 0.9)};
  const Table table = table_of(deformation_pattern_table, lines, {subject});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0].figure, "vertex, as it is");
  EXPECT_EQ(cell_text(table.rows[0].cells[0], 2), "2,801 (paper: 2,770)");
  EXPECT_EQ(cell_text(table.rows[0].cells[1], 2), "1.80 (paper: 1.79)");
  EXPECT_EQ(cell_text(table.rows[0].cells[2], 2), "0.90 (paper: 0.97)");
  EXPECT_EQ(cell_text(table.rows[0].cells.back(), 2), "1.00 (paper: 21.01)");
  EXPECT_EQ(table.rows[0].cells.size(), table.columns.size());
  const Table lone = table_of(deformation_pattern_table, {lines[1]}, {subject});
  EXPECT_NE(lone.rows[0].cells[1].reason.find("nidus-lattice"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
