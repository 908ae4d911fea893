#include "reports/charts/figures.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/charts/testing_tips.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

TEST(Figures, EveryCaseHasAllMeshersInThePlaneOfDistanceAndAngle) {
  Json a = job_line("nidus", "cbc3d", 100), b = job_line("nidus", "cgal", 100);
  a["summary"] = {
      {"hausdorff_diagonals", 1.0}, {"min_dihedral_deg", 21.0}, {"elements", 25000}, {"missing_labels", {3}}};
  b["summary"] = {{"hausdorff_diagonals", 5.0}, {"min_dihedral_deg", 12.0}, {"elements", 47000}};
  std::vector<std::string> names;
  for (const Figure& figure : result_figures(decode_lines({a, b, crashed_line("nidus", "tetgen", "oops")}))) {
    if (figure.name.rfind("distance-", 0) == 0) {
      names.push_back(figure.name);
      EXPECT_NE(test::tip_of(figure.svg, "nidus, cbc3d (1 label missing)").find(": 1&#10;"),
                std::string::npos)
          << figure.svg;
      EXPECT_NE(test::tip_of(figure.svg, "nidus, cgal").find(": 5&#10;"), std::string::npos);
      EXPECT_EQ(figure.svg.find("tetgen"), std::string::npos);
      EXPECT_EQ(figure.svg.find("nan"), std::string::npos);
    }
  }
  EXPECT_EQ(names, (std::vector<std::string>{"distance-angle-nidus", "distance-elements-nidus"}));
}

TEST(Figures, EveryMetricThatNamesAChartHasOne) {
  std::vector<std::string> names;
  Json line = timed_line("nidus", "cbc3d", 100, 2);
  line["fidelity"]["surface_hausdorff_mm"] = 1.25;
  line["quality"]["dihedral_histogram_5deg"] = std::vector<int>(36, 2);
  for (const Figure& figure : result_figures(decode_lines({line}))) {
    names.push_back(figure.name);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"time", "hausdorff", "surface-distance", "histogram-nidus"}));
}

TEST(Figures, AreWrittenAsSvg) {
  const TemporaryFolder folder;
  TerminalProgress progress(true);
  write_figures(result_figures(decode_lines({timed_line("nidus", "cbc3d", 100, 2)})),
                folder.path() / "figures", progress);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "figures" / "hausdorff.svg"));
}

}  // namespace
}  // namespace cbc3d::reports
