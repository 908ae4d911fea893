#include "mesher/input/table_rows.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

TEST(TableRows, CollectNames) {
  TableRows rows("cannot read 'a'");
  rows.begin_line(1, "-5 heart");
  rows.add(" -5 ", " heart ", Colour{1, 2, 3});
  EXPECT_EQ(rows.names().text(-5), "heart (-5)");
  EXPECT_EQ(rows.colour(std::string("1, 2, 3")), (Colour{1, 2, 3}));
  EXPECT_FALSE(rows.colour(std::string(" N/A")));
  EXPECT_THROW(static_cast<void>(rows.colour(std::string("red"))), InputError);
  EXPECT_THROW(rows.add("-5", "again", {}), InputError);
  EXPECT_THROW(static_cast<void>(TableRows("x").names()), InputError);
}

}  // namespace
}  // namespace cbc3d
