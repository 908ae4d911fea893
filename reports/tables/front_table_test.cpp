#include "reports/tables/front_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Json budget_line(const std::string& mesher, int budget, int tets, double distance_mm, double mean_ratio) {
  Json line = job_line("liver", mesher, tets);
  line["budget"] = budget;
  line["fidelity"]["mean_distance_mm"] = distance_mm;
  line["fidelity"]["hausdorff_mm"] = nullptr;
  line["fidelity"]["per_label"] = nullptr;
  line["quality"]["mean_ratio"] = {{"median", mean_ratio}};
  return line;
}

std::vector<Json> three_meshers() {
  Json floor = budget_line("tetgen", 1000, 90000, 0.1, 0.9);
  floor["size_search"] = {{"met", false}, {"reason", "no fewer than 90,000 elements at max-volume=8"}};
  return {budget_line("cbc3d", 1000, 1000, 0.4, 0.6), budget_line("cgal", 1000, 1000, 0.2, 0.9), floor};
}

TEST(FrontTable, SaysWhoIsBestAndByWhichFactor) {
  const Table table = table_of(front_table, three_meshers());
  EXPECT_EQ(table.columns, (std::vector<std::string>{"cbc3d", "cgal", "tetgen", "best",
                                                     "second best over best", "cbc3d over best"}));
  const std::string name = "liver, 1,000 elements";
  EXPECT_EQ(text_in(table, name, "elements of the mesh", 2), "90,000");
  const std::string distance = "mean surface distance (mm)";
  EXPECT_EQ(text_in(table, name, distance, 0), "0.400");
  EXPECT_EQ(text_in(table, name, distance, 2), "-");
  EXPECT_EQ(row_of(table, distance).cells[2].reason, "no fewer than 90,000 elements at max-volume=8");
  EXPECT_EQ(text_in(table, name, distance, 3), "cgal");
  EXPECT_EQ(text_in(table, name, distance, 4), "2.00");
  EXPECT_EQ(text_in(table, name, distance, 5), "2.00");
  EXPECT_EQ(row_of(table, "mean ratio, median").cells[5].value.value(), 1.5);
}

TEST(FrontTable, AFigureOfOneMesherHasNoFactor) {
  std::vector<Json> lines = three_meshers();
  lines[0]["topology"]["differences"] = 3;
  const Table table = table_of(front_table, lines);
  const std::string name = "liver, 1,000 elements", figure = "topology differences";
  EXPECT_EQ(text_in(table, name, figure, 3), "cbc3d");
  EXPECT_EQ(text_in(table, name, figure, 4), "no other mesh");
  EXPECT_EQ(text_in(table, name, figure, 5), "no other mesh");
}

TEST(FrontTable, AMeshThatWasNotSolvedSaysWhy) {
  std::vector<Json> lines = three_meshers();
  lines[0]["solver"] = {{"poisson_p1", {{"h1_relative", .3}}}, {"reason", ""}};
  lines[1]["solver"] = {{"poisson_p1", nullptr}, {"reason", "not solved: no convergence"}};
  const Table table = table_of(front_table, lines);
  EXPECT_EQ(row_of(table, "P1 H1 error").cells[1].reason, "not solved: no convergence");
}

TEST(FrontTable, LossesAreSortedAndNotHidden) {
  std::vector<Json> lines = three_meshers();
  lines[0]["topology"]["differences"] = 3;
  lines[1]["topology"]["differences"] = 0;
  const Table table = table_of(front_loss_table, lines);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.rows[0].figure, "topology differences");
  EXPECT_EQ(cell_text(table.rows[0].cells[3], 2), "infinite: the best has 0");
  EXPECT_EQ(table.rows[1].figure, "mean surface distance (mm)");
  EXPECT_EQ(table.rows[2].figure, "mean ratio, median");
  EXPECT_EQ(cell_text(table.rows[2].cells[2], 0), "cgal");
}

TEST(FrontTable, AMeshThatCbc3dDoesNotHaveIsALoss) {
  const Table table = table_of(
      front_loss_table, {budget_line("cgal", 1000, 1000, 0.2, 0.9), crashed_line("liver", "cbc3d", "x")});
  ASSERT_FALSE(table.rows.empty());
  EXPECT_EQ(cell_text(table.rows[0].cells[3], 2), "no such mesh");
}

TEST(FrontTable, ARunWithoutBudgetsHasNone) {
  EXPECT_TRUE(table_of(front_table, {job_line("liver", "cbc3d", 10)}).rows.empty());
  EXPECT_TRUE(table_of(front_loss_table, {job_line("liver", "cbc3d", 10)}).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
