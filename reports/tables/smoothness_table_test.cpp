#include "reports/tables/smoothness_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/cells.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

TEST(SmoothnessTable, HasTheVoxelSurfaceBesideTheMeshers) {
  Json known = job_line("ball", "cbc3d", 100);
  known["shape"] = {{"normal_deviation_deg", 5.0},
                    {"voxel_surface", {{"normal_deviation_deg", 45.0}}},
                    {"per_label", Json::array({1})}};
  const Table smooth = table_of(smoothness_table, {known, job_line("nidus", "cbc3d", 1)});
  EXPECT_EQ(smooth.columns, (std::vector<std::string>{"cbc3d", "voxel surface"}));
  ASSERT_EQ(smooth.rows.size(), metrics_of_table("smoothness").size());  // of the ball alone
  EXPECT_EQ(smooth.rows[0].cells[0].value, 5);
  EXPECT_EQ(smooth.rows[0].cells[1].value, 45);
  EXPECT_TRUE(table_of(smoothness_table, {job_line("nidus", "cbc3d", 1)}).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
