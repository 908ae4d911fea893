#include "baselines/core/driver.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

ParameterValues values() {
  return ParameterValues({{"size", "2.5", "mm", "a length"}, {"on", "true", "true|false", "a switch"}});
}

TEST(ParameterValues, StartFromTheDefaults) {
  EXPECT_EQ(values().number("size", 0, 10), 2.5);
  EXPECT_TRUE(values().flag("on"));
}

TEST(ParameterValues, RefuseWhatIsNoNumberOrOutOfRange) {
  ParameterValues given = values();
  for (const char* bad : {"", "abc", "2mm", "nan", "inf", "-1", "11"}) {
    given.text("size") = bad;
    EXPECT_THROW((void)given.number("size", 0, 10), InputError) << bad;
  }
  given.text("size") = "1e1";
  EXPECT_EQ(given.number("size", 0, 10), 10);
  EXPECT_EQ(given.count("size", 0, 10), 10);
  given.text("size") = "2.5";
  EXPECT_THROW((void)given.count("size", 0, 10), InputError);
}

TEST(ParameterValues, RefuseWhatIsNoSwitch) {
  ParameterValues given = values();
  given.text("on") = "yes";
  EXPECT_THROW((void)given.flag("on"), InputError);
  given.text("on") = "false";
  EXPECT_FALSE(given.flag("on"));
}

TEST(ParameterValues, RefuseWhatIsNoChoice) {
  ParameterValues given({{"fruit", "pear", "", "something to eat"}});
  EXPECT_EQ(given.one_of("fruit", {"apple", "pear", "fig"}), "pear");
  given.text("fruit") = "stone";
  try {
    (void)given.one_of("fruit", {"apple", "pear", "fig"});
    FAIL() << "a stone was taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--fruit stone: give apple, pear or fig");
  }
}

}  // namespace
}  // namespace cbc3d::baselines
