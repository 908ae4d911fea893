#include "reports/tables/markup.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(Markup, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Markup, TextIsMadeSafe) {
  EXPECT_EQ(markup_text("a < \"b\" & c\n"), "a &lt; &quot;b&quot; &amp; c ");
  EXPECT_EQ(markdown_text("a | b\nc"), "a \\| b c");
  EXPECT_EQ(replace_all("aaa", "a", "aa"), "aaaaaa");
}

}  // namespace
}  // namespace cbc3d::reports
