#include "mesher/command_line/number_range.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cbc3d {
namespace {

TEST(NumberRange, TakesFiniteNumbersWithinItsBoundsAlone) {
  const CLI::Validator range = number_between(0.5, 1e6);
  for (const char* const good : {"0.5", "1e6", "1000000", "+3", "2.5e1"}) {
    EXPECT_EQ(range(std::string(good)), "") << good;
  }
  for (const char* const bad :
       {"nan", "inf", "-inf", "1e300", "1e999", "0", "-1", "", "1x", "x", "+-1", "1,5"}) {
    EXPECT_EQ(range(std::string(bad)), bad + std::string(": give a number from 0.5 to 1000000")) << bad;
  }
}

TEST(NumberRange, TakesWholeNumbersWithinTheirBoundsAlone) {
  const CLI::Validator range = whole_number_between(-2, 1024);
  for (const char* const good : {"-2", "0", "+7", "1024"}) EXPECT_EQ(range(std::string(good)), "") << good;
  for (const char* const bad : {"-3", "1025", "1.5", "1e3", "nan", "99999999999999999999"}) {
    EXPECT_EQ(range(std::string(bad)), bad + std::string(": give a whole number from -2 to 1024")) << bad;
  }
}

TEST(NumberRange, MessagesAreShort) {
  CLI::App app;
  double seconds = 1;
  app.add_option("--timeout", seconds)->check(number_between(0.001, 1e7));
  try {
    app.parse("--timeout " + std::string(300, '9'));
    FAIL();
  } catch (const CLI::ValidationError& error) {
    EXPECT_EQ(error.what(),
              "--timeout: " + std::string(37, '9') + "...: give a number from 0.001 to 10000000");
  }
}

}  // namespace
}  // namespace cbc3d
