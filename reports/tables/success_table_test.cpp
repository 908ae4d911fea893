#include "reports/tables/success_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

/// A good mesh's line, of the n-th image.
Json good_line(int n, const std::string& mesher) {
  Json line = timed_line("many-" + std::to_string(n), mesher, 100 + n, 1 + n);
  line["fidelity"]["missing_labels"] = Json::array();
  line["quality"]["inverted"] = 0;
  line["quality"]["min_dihedral_deg"] = 30 - n;
  line["topology"] = {{"conforming", true},
                      {"non_manifold_edges", 0},
                      {"non_manifold_vertices", 0},
                      {"self_intersections", 0},
                      {"differences", 0}};
  return line;
}

std::vector<Json> twenty_of(const std::string& mesher) {
  std::vector<Json> lines;
  lines.reserve(20);
  for (int n = 0; n < 20; ++n) lines.push_back(good_line(n, mesher));
  return lines;
}

std::string text(const Table& table, const std::string& figure, std::size_t column = 0) {
  return text_in(table, "20 images", figure, column);
}

TEST(SuccessTable, EveryFaultCountsInItsOwnRow) {
  std::vector<Json> lines = twenty_of("cbc3d");
  lines[0]["quality"]["inverted"] = 2;
  lines[1]["topology"]["differences"] = 1;
  lines[2]["fidelity"]["missing_labels"] = {7};
  lines[3] = crashed_line("many-3", "cbc3d", "SIGSEGV");
  lines[4]["topology"]["conforming"] = false;
  const Table table = table_of(success_table, lines);
  EXPECT_EQ(text(table, "meshes made (%)"), "95.0");
  EXPECT_EQ(text(table, "valid (%)"), "85.0");
  EXPECT_EQ(text(table, "right topology (%)"), "90.0");
  EXPECT_EQ(text(table, "every label (%)"), "90.0");
  EXPECT_EQ(text(table, "all of these (%)"), "75.0");
  EXPECT_EQ(text(table, "failed: crashed: SIGSEGV"), "1");
}

TEST(SuccessTable, TheWorstIsNamedWithItsCase) {
  const Table table = table_of(success_table, twenty_of("cbc3d"));
  EXPECT_EQ(text(table, "smallest dihedral angle (deg)"), "11.00 (many-19)");
  EXPECT_EQ(text(table, "slowest (s)"), "20.00 (many-19)");
  EXPECT_EQ(text(table, "most elements"), "119 (many-19)");
  EXPECT_EQ(text(table, "CPU time of all (s)"), "210");
}

TEST(SuccessTable, FailuresAreGroupedByReasonWithoutNamesAndNumbers) {
  std::vector<Json> lines = twenty_of("cbc3d");
  const std::vector<Json> others = twenty_of("cgal");
  lines.insert(lines.end(), others.begin(), others.end());
  lines[5] = crashed_line("many-5", "cbc3d", "no room in 'a.vtu' for 12 cells");
  lines[6] = crashed_line("many-6", "cbc3d", "no room in 'b.vtu' for 345 cells");
  const Table table = table_of(success_table, lines);
  EXPECT_EQ(text(table, "failed: crashed: no room in ... for N cells", 0), "2");
  EXPECT_EQ(text(table, "failed: crashed: no room in ... for N cells", 1), "0");
}

TEST(SuccessTable, JobsThatCouldNotRunDoNotCount) {
  std::vector<Json> lines = twenty_of("cbc3d");
  lines[0]["status"] = "skipped";
  lines[1]["status"] = "unavailable";
  EXPECT_EQ(text(table_of(success_table, lines), "meshes made (%)"), "100.0");
}

TEST(SuccessTable, FewImagesHaveNoRows) {
  EXPECT_TRUE(table_of(success_table, {good_line(0, "cbc3d")}).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
