#include "mesher/core/plain_name.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cbc3d {
namespace {

TEST(PlainName, IsOfLettersDigitsHyphensAndUnderscores) {
  for (const std::string& name :
       {std::string("liver"), std::string("A-1_b"), std::string(kLongestName, 'x')}) {
    EXPECT_TRUE(is_plain_name(name)) << name;
  }
  for (const std::string& name :
       {std::string(), std::string(".."), std::string("a/b"), std::string("../x"), std::string("a b"),
        std::string("a\nb"), std::string("a.b"), std::string("\xC3\xA4"), std::string("a\0b", 3),
        std::string(kLongestName + 1, 'x'), std::string("C:")}) {
    EXPECT_FALSE(is_plain_name(name)) << name;
  }
}

}  // namespace
}  // namespace cbc3d
