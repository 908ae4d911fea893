#include "reports/tables/target_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Json compared_line(const std::string& mesher, double angle_deg, double error_percent, int elements) {
  Json line = job_line("nidus", mesher, elements);
  line["summary"]["min_dihedral_deg"] = angle_deg;
  line["summary"]["min_dihedral_label"] = 4;
  line["summary"]["volume_error_percent"] = error_percent;
  line["summary"]["volume_error_label"] = 2;
  line["summary"]["elements"] = elements;
  return line;
}

TEST(TargetTable, LabelsHaveTheirNames) {
  Json line = compared_line("cbc3d", 20, .5, 3000);
  line["image"] = {{"size", {8, 9, 10}},
                   {"spacing_mm", {1, 1, 1}},
                   {"labels", {2, 4}},
                   {"label_names", {{"4", "right lung"}}}};
  const Table targets = table_of(target_table, {line, compared_line("cgal", 16, -1.25, 2000)});
  EXPECT_EQ(text_in(targets, "nidus", "shape: min dihedral angle (deg)", 0),
            "1.00 (20.00 deg, right lung (4))");
}

TEST(TargetTable, FiguresAreMultiplesOfTheBest) {
  const Table targets =
      table_of(target_table, {compared_line("cbc3d", 20, .5, 3000), compared_line("cgal", 16, -1.25, 2000),
                              crashed_line("nidus", "tetgen", "oops")});
  const auto text = [&](const std::string& figure, std::size_t column) {
    return text_in(targets, "nidus", figure, column);
  };
  const std::string angle = "shape: min dihedral angle (deg)",
                    volume = "labels: volume error, labels above 500 voxels (%)";
  EXPECT_EQ(text(angle, 0), "1.00 (20.00 deg, label 4)");
  EXPECT_EQ(text(angle, 1), "1.25 (16.00 deg, label 4)");  // more is worse, although higher angles are better
  EXPECT_EQ(text(angle, 2), "-");
  EXPECT_EQ(text(volume, 0), "1.00 (0.50 %, label 2)");
  EXPECT_EQ(text(volume, 1), "2.50 (1.25 %, label 2)");  // whichever its sign
  EXPECT_EQ(text("count: elements", 0), "1.50 (3,000)");
  EXPECT_EQ(text("smooth: angle between facets, rms (deg)", 0), "-");  // not known of any
  EXPECT_EQ(text("solver: P1 H1 error", 0), "no row solver: P1 H1 error");
  EXPECT_EQ(to_json(targets)["rows"][0]["cells"]["tetgen"]["reason"], "crashed: oops");
  EXPECT_NE(to_csv(targets).find("1.25,,\"16.00 deg, label 4\""), std::string::npos) << to_csv(targets);
}

TEST(TargetTable, WhereTheBestIsZeroTheFiguresStandThemselves) {
  Json a = compared_line("cbc3d", 20, .5, 10), b = compared_line("cgal", 0, 0, 10);
  a["surface"]["facets_over_90_deg"] = 7;
  b["surface"]["facets_over_90_deg"] = 0;
  const Table targets = table_of(target_table, {a, b});
  const auto text = [&](const std::string& figure, std::size_t column) {
    return text_in(targets, "nidus", figure, column);
  };
  const std::string pairs = "smooth: pairs of facets over 90 deg, itself (the best is 0)";
  EXPECT_EQ(text(pairs, 0), "7");
  EXPECT_EQ(text(pairs, 1), "0");
  EXPECT_EQ(text("labels: volume error, labels above 500 voxels (%), itself (the best is 0)", 0),
            "0.50 (label 2)");
  // An angle of 0 has no multiple, for it would be infinite.
  EXPECT_EQ(text("shape: min dihedral angle (deg)", 1), "0.00 deg, no multiple, label 4");
  EXPECT_EQ(text("shape: min dihedral angle (deg)", 0), "1.00 (20.00 deg, label 4)");
}

TEST(TargetTable, WhereTheBestIsARoundingErrorTheFiguresStandThemselves) {
  const Table targets =
      table_of(target_table, {compared_line("cbc3d", 20, .5, 10), compared_line("cgal", 20, 1e-11, 10)});
  const std::string row = "labels: volume error, labels above 500 voxels (%), itself (the best is 0)";
  EXPECT_EQ(text_in(targets, "nidus", row, 0), "0.50 (label 2)");
  EXPECT_EQ(text_in(targets, "nidus", row, 1), "0.00 (label 2)");
}

TEST(TargetTable, WhereEvenTheBestIsNegativeTheFiguresStandThemselves) {
  Json a = job_line("nidus", "cbc3d", 10), b = job_line("nidus", "cgal", 10);
  a["quality"]["mean_ratio"]["p1"] = -.5;
  b["quality"]["mean_ratio"]["p1"] = -.25;
  const Table targets = table_of(target_table, {a, b});
  EXPECT_EQ(text_in(targets, "nidus", "shape: mean ratio, 1 %, itself (the best is -0.250)", 0), "-0.500");
}

TEST(TargetTable, HardFaultsStandApart) {
  Json good = job_line("nidus", "cbc3d", 100), bad = job_line("nidus", "cgal", 100);
  good["summary"] = {{"inverted", 0}, {"missing_labels", Json::array()}, {"self_intersections", 0}};
  bad["summary"] = {{"inverted", 0},
                    {"missing_labels", {5, 6}},
                    {"self_intersections", 3},
                    {"self_intersection_labels", {7}},
                    {"topology_differences", 162},
                    {"topology_difference_labels", {1}}};
  const Table targets = table_of(target_table, {good, bad, crashed_line("nidus", "tetgen", "oops")});
  const auto text = [&](const std::string& figure, std::size_t column) {
    return text_in(targets, "nidus", "hard fault" + figure, column);
  };
  EXPECT_EQ(text(": labels above 50 voxels lost", 0), "0");
  EXPECT_EQ(text(": labels above 50 voxels lost", 1), "2 (labels 5, 6)");
  EXPECT_EQ(text(": self-intersections", 1), "3 (label 7)");
  EXPECT_EQ(text(": labels of another topology", 1), "1 (label 1)");
  EXPECT_EQ(text("s, kinds", 0), "0");
  EXPECT_EQ(text("s, kinds", 1), "3");
  EXPECT_EQ(text("s, kinds", 2), "-");
  EXPECT_TRUE(row_of(targets, "hard fault: self-intersections").cells[1].missed);
  EXPECT_FALSE(row_of(targets, "hard fault: inverted elements").cells[1].missed);
}

Json budget_line(const std::string& mesher, int budget, int elements, double distance_mm) {
  Json line = compared_line(mesher, 20, .5, elements);
  line["budget"] = budget;
  line["counts"]["tets"] = elements;
  line["fidelity"]["mean_distance_mm"] = distance_mm;
  return line;
}

TEST(TargetTable, BudgetsAreComparedAtExactlyEqualElements) {
  // Both distances are c / elements, with c twice as large for cgal, whose meshes miss the budgets.
  std::vector<Json> lines;
  for (const int budget : {10000, 40000}) {
    lines.push_back(budget_line("cbc3d", budget, budget, 1e4 / budget));
    lines.push_back(budget_line("cgal", budget, budget * 19 / 20, 2e4 / (budget * .95)));
  }
  Json floor = budget_line("tetgen", 10000, 90000, .01);
  floor["size_search"] = {{"met", false}, {"reason", "no fewer than 90,000 elements at max-volume=8"}};
  floor["summary"]["inverted"] = 2;
  lines.push_back(floor);
  const Table targets = table_of(target_table, lines);
  const std::string name = "nidus, 10,000 elements", distance = "distance: mean surface distance (mm)";
  EXPECT_EQ(text_in(targets, name, distance, 0), "1.00 (1.000 mm)");
  EXPECT_EQ(text_in(targets, name, distance, 1), "2.00 (2.000 mm)");
  EXPECT_EQ(text_in(targets, name, distance, 2), "-");
  EXPECT_EQ(row_of(targets, distance).cells[2].reason, "no fewer than 90,000 elements at max-volume=8");
  EXPECT_EQ(text_in(targets, name, "count: elements", 2), "9.47 (90,000)");
  EXPECT_EQ(row_of(targets, "hard fault: inverted elements").cells[2].value, 2);
  EXPECT_NE(targets.title.find("interpolated to exactly so many elements"), std::string::npos)
      << targets.title;
  EXPECT_EQ(targets.title.find("Not at equal elements"), std::string::npos) << targets.title;
}

TEST(TargetTable, WithoutBudgetsTheTitleHasTheCounts) {
  const Table targets =
      table_of(target_table, {compared_line("cbc3d", 20, .5, 3000), compared_line("cgal", 16, -1.25, 12000)});
  EXPECT_NE(targets.title.find("Not at equal elements, which are: nidus: 3,000 (cbc3d), 12,000 (cgal)"),
            std::string::npos)
      << targets.title;
}

TEST(TargetTable, SolverIsThereWhereItWasAsked) {
  Json a = job_line("nidus", "cbc3d", 10), b = job_line("nidus", "cgal", 10);
  a["solver"] = {{"poisson_p1", {{"h1_relative", .3}}}, {"reason", ""}};
  b["solver"] = {{"poisson_p1", nullptr}, {"reason", "not solved: no convergence"}};
  const Table targets = table_of(target_table, {a, b});
  EXPECT_EQ(text_in(targets, "nidus", "solver: P1 H1 error", 0), "1.00 (0.30000)");
  EXPECT_EQ(row_of(targets, "solver: P1 H1 error").cells[1].reason, "not solved: no convergence");
}

}  // namespace
}  // namespace cbc3d::reports
