#include "reports/tables/table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/catalog_table.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

/// The table of element counts of these lines.
Table counts(std::vector<Json> lines) {
  return table_of(catalog_table("element_count", "Element count"), std::move(lines));
}

TEST(Table, AFailedJobIsADashWithItsReasonBeneath) {
  const Table table = counts({job_line("nidus", "cbc3d", 1234567), crashed_line("nidus", "cgal", "a | b_c")});
  EXPECT_EQ(to_markdown(table),
            "### Element count\n\n"
            "| case  | figure     |     cbc3d |  cgal |\n"
            "|-------|------------|----------:|------:|\n"
            "| nidus | tetrahedra | 1,234,567 | - [1] |\n"
            "\n[1] nidus, cgal: crashed: a \\| b_c  \n");
  EXPECT_EQ(to_csv(table),
            "case,figure,cbc3d,cgal,cgal reason\n"
            "nidus,tetrahedra,1234567,-,crashed: a | b_c\n");
  const std::string latex = to_latex(table);
  EXPECT_NE(latex.find("nidus & tetrahedra & 1,234,567 & -$^{1}$ \\\\"), std::string::npos) << latex;
  EXPECT_NE(latex.find("$^{1}$ nidus, cgal: crashed: a | b\\_c"), std::string::npos) << latex;
  const Json json = to_json(table);
  EXPECT_TRUE(json["rows"][0]["cells"]["cgal"]["value"].is_null());
  EXPECT_EQ(json["rows"][0]["cells"]["cgal"]["reason"], "crashed: a | b_c");
  EXPECT_EQ(json["rows"][0]["cells"]["cbc3d"]["value"], 1234567);
}

TEST(Table, WhatASpreadsheetWouldTakeForAFormulaIsQuoted) {
  const std::string csv =
      to_csv(counts({job_line("=cmd|'x'!A0", "+mesher", 7), crashed_line("@sum", "+mesher", "-1+\"2\"")}));
  EXPECT_NE(csv.find("\"'+mesher\""), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n\"'=cmd|'x'!A0\",tetrahedra,7"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\n\"'@sum\",tetrahedra,-,\"crashed: -1+\"\"2\"\"\""), std::string::npos) << csv;
}

TEST(Table, OneNoteServesAllFiguresOfAJob) {
  const Table table = table_of(catalog_table("fidelity", ""), {crashed_line("nidus", "cgal", "oops")});
  EXPECT_GT(table.rows.size(), 1U);
  EXPECT_EQ(Footnotes(table).notes().size(), 1U);
}

TEST(Table, RepeatsAreMedianAndRange) {
  const Table table = counts(
      {job_line("nidus", "cgal", 30), job_line("nidus", "cgal", 10, 1), job_line("nidus", "cgal", 20, 2)});
  EXPECT_EQ(cell_text(table.rows[0].cells[0], 0), "20 [10-30]");
  EXPECT_NE(to_csv(table).find("20,10,30"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
