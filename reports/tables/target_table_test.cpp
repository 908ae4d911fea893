#include "reports/tables/target_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

TEST(TargetTable, SaysWhatIsMissedAndWhere) {
  Json good = job_line("nidus", "cbc3d", 100), bad = job_line("nidus", "cgal", 100);
  good["summary"] = {{"min_dihedral_deg", 21.5},        {"min_dihedral_label", 4},
                     {"image_to_mesh_diagonals", 1.1},  {"image_to_mesh_label", 4},
                     {"missing_labels", Json::array()}, {"self_intersections", 0}};
  bad["summary"] = {{"min_dihedral_deg", 9.0},        {"min_dihedral_label", 7},
                    {"volume_error_percent", -1.5},   {"volume_error_label", 2},
                    {"missing_labels", {5, 6}},       {"self_intersections", 3},
                    {"self_intersection_labels", {7}}};
  const Table targets = table_of(target_table, {good, bad, crashed_line("nidus", "tetgen", "oops")});
  const auto text = [&](const std::string& figure, std::size_t column) {
    return text_in(targets, "nidus", figure, column);
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

}  // namespace
}  // namespace cbc3d::reports
