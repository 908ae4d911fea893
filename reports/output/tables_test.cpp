#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "reports/charts/figures.hpp"
#include "reports/results/testing_folder.hpp"
#include "reports/tables/tables.hpp"

namespace cbc3d::reports {
namespace {

Json line(const std::string& case_name, const std::string& mesher, int tets, int repeat = 0,
          int threads = 1) {
  Json result = empty_result();
  result["case"] = case_name;
  result["mesher"] = mesher;
  result["threads"] = threads;
  result["repeat"] = repeat;
  result["status"] = "ok";
  result["counts"]["tets"] = tets;
  result["fidelity"]["hausdorff_mm"] = 1.5;
  result["fidelity"]["missing_labels"] = {4, 5};
  result["fidelity"]["per_label"] = {{{"volume_error_percent", 1.0}}, {{"volume_error_percent", -3.25}}};
  result["peak_rss_bytes"] = 250'000'000;
  return result;
}

Json failure(const std::string& case_name, const std::string& mesher, const std::string& reason) {
  Json result = line(case_name, mesher, 0);
  result["status"] = "crashed";
  result["reason"] = reason;
  return result;
}

std::vector<cases::Case> cases_with_paper(const nlohmann::json& paper) {
  cases::Case subject;
  subject.name = "nidus";
  subject.paper = paper;
  return {subject};
}

const Table& table(const std::vector<Table>& tables, const std::string& name) {
  for (const Table& candidate : tables) {
    if (candidate.name == name) {
      return candidate;
    }
  }
  throw std::out_of_range(name);
}

const Row& row(const Table& from, const std::string& figure) {
  for (const Row& candidate : from.rows) {
    if (candidate.figure == figure) {
      return candidate;
    }
  }
  throw std::out_of_range(figure);
}

TEST(Tables, AFailedJobIsADashWithItsReasonBeneath) {
  const auto tables =
      build_tables({line("nidus", "cbc3d", 1234567), failure("nidus", "cgal", "a | b_c")}, {});
  EXPECT_EQ(to_markdown(table(tables, "element_count")),
            "### Element count\n\n"
            "| case  | figure     |     cbc3d |  cgal |\n"
            "|-------|------------|----------:|------:|\n"
            "| nidus | tetrahedra | 1,234,567 | - [1] |\n"
            "\n[1] nidus, cgal: crashed: a \\| b_c  \n");
  EXPECT_EQ(to_csv(table(tables, "element_count")),
            "case,figure,cbc3d,cgal,cgal reason\n"
            "nidus,tetrahedra,1234567,-,crashed: a | b_c\n");
  const std::string latex = to_latex(table(tables, "element_count"));
  EXPECT_NE(latex.find("nidus & tetrahedra & 1,234,567 & -$^{1}$ \\\\"), std::string::npos) << latex;
  EXPECT_NE(latex.find("$^{1}$ nidus, cgal: crashed: a | b\\_c"), std::string::npos) << latex;
  const Json json = to_json(table(tables, "element_count"));
  EXPECT_TRUE(json["rows"][0]["cells"]["cgal"]["value"].is_null());
  EXPECT_EQ(json["rows"][0]["cells"]["cgal"]["reason"], "crashed: a | b_c");
  EXPECT_EQ(json["rows"][0]["cells"]["cbc3d"]["value"], 1234567);
}

TEST(Tables, OneNoteServesAllFiguresOfAJob) {
  const auto tables = build_tables({failure("nidus", "cgal", "oops")}, {});
  EXPECT_EQ(Footnotes(table(tables, "fidelity")).notes().size(), 1U);
}

TEST(Tables, RepeatsAreMedianAndRange) {
  const auto tables = build_tables(
      {line("nidus", "cgal", 30), line("nidus", "cgal", 10, 1), line("nidus", "cgal", 20, 2)}, {});
  const Cell& cell = table(tables, "element_count").rows[0].cells[0];
  EXPECT_EQ(cell_text(cell, 0), "20 [10-30]");
  EXPECT_EQ(cell.runs, 3);
  EXPECT_NE(to_csv(table(tables, "element_count")).find("20,10,30"), std::string::npos);
}

TEST(Tables, SomeFailedRepeatsAreSaidBesideTheFigure) {
  Json bad = failure("nidus", "cgal", "oops");
  bad["repeat"] = 1;
  const auto tables = build_tables({line("nidus", "cgal", 30), bad}, {});
  const Cell& cell = table(tables, "element_count").rows[0].cells[0];
  EXPECT_EQ(cell.value, 30);
  EXPECT_EQ(cell.reason, "1 of 2 runs crashed: oops");
}

TEST(Tables, ThePapersFigureStandsBesideOurs) {
  const auto cases = cases_with_paper({{"cbc3d", {{"hausdorff_mm", 4.51}, {"tets", 272000}}}});
  const auto tables = build_tables(
      {line("nidus", "cbc3d-paper", 300000), line("nidus", "cbc3d-mixed", 1), line("nidus", "cgal", 1)},
      cases);
  const Row& count = table(tables, "element_count").rows[0];
  EXPECT_EQ(cell_text(count.cells[0], 0), "300,000 (paper: 272,000)");
  EXPECT_FALSE(count.cells[1].paper.has_value());
  EXPECT_FALSE(count.cells[2].paper.has_value());
  EXPECT_EQ(row(table(tables, "fidelity"), "HD (mm)").cells[0].paper, 4.51);
  EXPECT_NE(to_csv(table(tables, "fidelity")).find("cbc3d-paper (paper)"), std::string::npos);
}

TEST(Tables, TheDeformationFigureNeedsTheSameIterationsAndPattern) {
  const auto cases = cases_with_paper(
      {{"deformation", {{"iterations", 10}, {"patterns", {{"face", {{"hausdorff_mm", 0.88}}}}}}}});
  Json run = line("nidus", "cbc3d-paper", 1);
  run["parameters"] = {{"connectivity", "face"}, {"iterations", "10"}};
  EXPECT_EQ(table(build_tables({run}, cases), "fidelity").rows[0].cells[0].paper, 0.88);
  run["parameters"]["iterations"] = "5";
  EXPECT_FALSE(table(build_tables({run}, cases), "fidelity").rows[0].cells[0].paper.has_value());
}

TEST(Tables, FiguresMadeOfSeveral) {
  const auto tables = build_tables({line("nidus", "cgal", 1)}, {});
  EXPECT_EQ(row(table(tables, "fidelity"), "largest volume error of a label (%)").cells[0].value, 3.25);
  EXPECT_EQ(row(table(tables, "fidelity"), "labels missing").cells[0].value, 2);
  EXPECT_EQ(row(table(tables, "time"), "peak memory (MB)").cells[0].value, 250);
}

TEST(Tables, AMesherHasAColumnForEveryThreadCount) {
  const auto tables = build_tables(
      {line("nidus", "cbc3d", 1), line("nidus", "cbc3d", 1, 0, 2), line("nidus", "cgal", 1)}, {});
  EXPECT_EQ(tables[0].columns, (std::vector<std::string>{"cbc3d (1 thread)", "cbc3d (2 threads)", "cgal"}));
}

TEST(Tables, AMesherThatDidNotRunACaseIsADash) {
  const auto tables = build_tables({line("nidus", "cbc3d", 1), line("liver", "cgal", 1)}, {});
  EXPECT_EQ(tables[0].rows[1].cells[0].reason, "not run");
}

TEST(Tables, VerticesAreShownForMixedMeshes) {
  Json mixed = line("nidus", "cbc3d-mixed", 1);
  EXPECT_EQ(build_tables({mixed}, {}).size(), 6U);
  mixed["counts"]["hexes"] = 12;
  EXPECT_EQ(row(table(build_tables({mixed}, {}), "vertices"), "hexahedra").cells[0].value, 12);
}

TEST(Tables, AreWrittenInTheWantedForms) {
  const TemporaryFolder folder;
  const auto tables = build_tables({line("nidus", "cgal", 1)}, {});
  write_tables(tables, folder.path() / "tables", {"csv", "tex"});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "tables" / "time.tex"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "tables" / "time.md"));
  EXPECT_THROW(write_tables(tables, folder.path() / "tables", {"pdf"}), InputError);
}

TEST(Tables, TargetsSayWhatIsMissedAndWhere) {
  Json good = line("nidus", "cbc3d", 100), bad = line("nidus", "cgal", 100);
  good["summary"] = {{"min_dihedral_deg", 21.5},        {"min_dihedral_label", 4},
                     {"image_to_mesh_diagonals", 1.1},  {"image_to_mesh_label", 4},
                     {"missing_labels", Json::array()}, {"self_intersections", 0}};
  bad["summary"] = {{"min_dihedral_deg", 9.0},        {"min_dihedral_label", 7},
                    {"volume_error_percent", -1.5},   {"volume_error_label", 2},
                    {"missing_labels", {5, 6}},       {"self_intersections", 3},
                    {"self_intersection_labels", {7}}};
  const auto tables = build_tables({good, bad, failure("nidus", "tetgen", "oops")}, {});
  const Table& targets = table(tables, "targets");
  const auto text = [&](const std::string& figure, std::size_t column) {
    const Row& found = row(targets, figure);
    return cell_text(found.cells[column], found.decimals);
  };
  EXPECT_EQ(text("min dihedral angle (deg), at least 20", 0), "21.50 (label 4)");
  EXPECT_EQ(text("min dihedral angle (deg), at least 20", 1), "9.00 missed (label 7)");
  EXPECT_EQ(text("HD image to mesh (voxel diagonals), at most 1.1", 0), "1.10 (label 4)");
  EXPECT_EQ(text("HD image to mesh (voxel diagonals), at most 1.1", 1), "-");
  EXPECT_EQ(text("volume error, labels above 500 voxels (%), at most 1", 1), "-1.50 missed (label 2)");
  EXPECT_EQ(text("labels above 50 voxels missing, at most 0", 0), "0");
  EXPECT_EQ(text("labels above 50 voxels missing, at most 0", 1), "2 missed (labels 5, 6)");
  EXPECT_EQ(text("self-intersections, at most 0", 1), "3 missed (label 7)");
  EXPECT_EQ(text("limits missed", 0), "0");
  EXPECT_EQ(text("limits missed", 1), "4");
  EXPECT_EQ(text("limits missed", 2), "-");
  EXPECT_NE(to_csv(targets).find("9,missed,label 7"), std::string::npos) << to_csv(targets);
  EXPECT_EQ(to_json(targets)["rows"][0]["cells"]["cgal"]["missed"], true);
}

TEST(Tables, SmoothnessHasTheVoxelSurfaceBesideTheMeshers) {
  Json known = line("ball", "cbc3d", 100);
  known["shape"] = {{"normal_deviation_deg", 5.0},
                    {"voxel_surface", {{"normal_deviation_deg", 45.0}}},
                    {"per_label", Json::array({1})}};
  const auto tables = build_tables({known, line("nidus", "cbc3d", 1)}, {});
  const Table& smooth = table(tables, "smoothness");
  EXPECT_EQ(smooth.columns, (std::vector<std::string>{"cbc3d", "voxel surface"}));
  ASSERT_EQ(smooth.rows.size(), 4U);  // of the ball alone
  EXPECT_EQ(smooth.rows[0].cells[0].value, 5);
  EXPECT_EQ(smooth.rows[0].cells[1].value, 45);
  EXPECT_THROW(table(build_tables({line("nidus", "cbc3d", 1)}, {}), "smoothness"), std::out_of_range);
}

TEST(Figures, EveryCaseHasAllMeshersInThePlaneOfDistanceAndAngle) {
  Json a = line("nidus", "cbc3d", 100), b = line("nidus", "cgal", 100);
  a["summary"] = {
      {"hausdorff_diagonals", 1.0}, {"min_dihedral_deg", 21.0}, {"elements", 25000}, {"missing_labels", {3}}};
  b["summary"] = {{"hausdorff_diagonals", 5.0}, {"min_dihedral_deg", 12.0}, {"elements", 47000}};
  std::vector<std::string> names;
  for (const Figure& figure : result_figures({a, b, failure("nidus", "tetgen", "oops")})) {
    if (figure.name.rfind("distance-", 0) == 0) {
      names.push_back(figure.name);
      EXPECT_NE(figure.svg.find("cbc3d (1 label missing): 1,"), std::string::npos) << figure.svg;
      EXPECT_NE(figure.svg.find("cgal: 5,"), std::string::npos);
      EXPECT_EQ(figure.svg.find("tetgen"), std::string::npos);
      EXPECT_EQ(figure.svg.find("nan"), std::string::npos);
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"distance-angle-nidus", "distance-elements-nidus"}));
}

TEST(Tables, NumbersHaveCommasBetweenThousands) {
  EXPECT_EQ(format_number(0, 0), "0");
  EXPECT_EQ(format_number(999, 0), "999");
  EXPECT_EQ(format_number(-1234567.891, 2), "-1,234,567.89");
}

}  // namespace
}  // namespace cbc3d::reports
