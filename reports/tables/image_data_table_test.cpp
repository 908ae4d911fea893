#include "reports/tables/image_data_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

TEST(ImageDataTable, StandsBesideThePapers) {
  Json line = job_line("box", "cgal", 1);
  line["image"] = {{"size", {8, 9, 10}}, {"spacing_mm", {0.5, 0.5, 1.25}}, {"labels", {1, 4}}};
  const Table images = table_of(image_data_table, {line, job_line("ball", "cgal", 1)});
  ASSERT_EQ(images.rows.size(), 6U);
  EXPECT_EQ(images.rows[0].cells[0].text, "anisotropic");
  EXPECT_EQ(images.rows[0].cells[1].text, "2 (labels 1, 4)");
  EXPECT_EQ(images.rows[0].cells[2].text, "0.50 x 0.50 x 1.25");
  EXPECT_EQ(images.rows[0].cells[3].text, "8 x 9 x 10");
  EXPECT_EQ(images.rows[1].figure, "not read: no mesh of it was evaluated");
  line["image"]["label_names"] = {{"4", "heart"}};
  EXPECT_EQ(table_of(image_data_table, {line}).rows[0].cells[1].text, "2 (labels 1, 4 heart)");
  EXPECT_EQ(images.rows[5].cells[3].text, "1001 x 1001 x 4182");
}

}  // namespace
}  // namespace cbc3d::reports
