#include "mesher/core/one_line.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

TEST(OneLine, HasNoControlCharacters) {
  EXPECT_EQ(one_line("a 'b\nc\x1B[31m\r\t\x7F'"), "a 'b?c?[31m" + std::string(3, '?') + "'");
  EXPECT_EQ(one_line("caf\xC3\xA9 \xE9"), "caf\xC3\xA9 \xE9");
  EXPECT_EQ(one_line(""), "");
}

}  // namespace
}  // namespace cbc3d
