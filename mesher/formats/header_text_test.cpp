#include "mesher/formats/header_text.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {
namespace {

TEST(HeaderText, ANumberIsAllOfItsText) {
  EXPECT_EQ(to_number(" +1.5e3 "), 1500);
  EXPECT_TRUE(std::isnan(to_number("nan").value_or(0)));
  EXPECT_FALSE(to_number("1.5x").has_value());
  EXPECT_FALSE(to_number("").has_value());
  EXPECT_FALSE(to_integer("8.9").has_value());
  EXPECT_FALSE(to_integer("99999999999999999999").has_value());
  EXPECT_EQ(numbers_of("k", "1 2\t3\r", 3), (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(numbers_of("k", "1 2", 3), FormatError);
  EXPECT_THROW(numbers_of("k", "1 inf 3", 3), FormatError);
  EXPECT_THROW(integers_of("k", "1 2.0", 2), FormatError);
  EXPECT_EQ(size_of("k", 7), 7U);
  EXPECT_THROW(size_of("k", 0), FormatError);
  EXPECT_THROW(size_of("k", std::int64_t{1} << 31U), FormatError);
}

TEST(HeaderText, WordsAndLines) {
  EXPECT_EQ(words_of(" a,b ", " ,"), (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(words_of("  ").empty());
  EXPECT_EQ(trimmed("\t a b \r\n"), "a b");
  EXPECT_EQ(lower_case("RaS"), "ras");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 70U);
  Lines lines("one\r\ntwo\n\nfour");
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.position(), 5U);
  EXPECT_EQ(lines.next(), "two");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "four");
  EXPECT_FALSE(lines.next().has_value());
}

}  // namespace
}  // namespace cbc3d::formats
