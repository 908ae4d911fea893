#include "mesher/core/one_line.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(OneLine, HasNoControlCharacters) {
  EXPECT_EQ(one_line("a 'b\nc\x1B[31m\r\t\x7F'"), "a 'b?c?[31m" + std::string(3, '?') + "'");
  EXPECT_EQ(one_line("caf\xC3\xA9 \xE9"), "caf\xC3\xA9 \xE9");
  EXPECT_EQ(one_line(""), "");
}

TEST(OneLine, ShortensLongNumbersButNoNames) {
  const std::string digits(300, '9'), name(300, 'n');
  EXPECT_EQ(one_line("--threads " + digits + " is no number"),
            "--threads " + digits.substr(0, 37) + "... is no number");
  EXPECT_EQ(one_line("'" + name + ".vtu'"), "'" + name + ".vtu'");
  EXPECT_EQ(with_short_words("--preset: " + name + " not in {a,b}"),
            "--preset: " + name.substr(0, 37) + "... not in {a,b}");
  EXPECT_EQ(shortened(std::string(40, 'x')), std::string(40, 'x'));
  EXPECT_EQ(shortened(std::string(41, 'x')), std::string(37, 'x') + "...");
}

}  // namespace
}  // namespace cbc3d
