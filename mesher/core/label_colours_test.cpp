#include "mesher/core/label_colours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace cbc3d {
namespace {

TEST(LabelColours, AreOfTheirOwn) {
  std::set<std::array<double, 3>> colours;
  for (std::size_t place = 0; place < 100; ++place) colours.insert(label_colour(place));
  EXPECT_EQ(colours.size(), 100U);
  EXPECT_EQ(label_colour(0), (std::array{0.85, 0.42, 0.36}));
}

// Of the circle: the largest channel is the value, the smallest what the saturation leaves of it.
TEST(LabelColours, OfTheCircleHaveOneValueAndSaturation) {
  for (std::size_t place = 10; place < 60; ++place) {
    const auto colour = label_colour(place);
    EXPECT_DOUBLE_EQ(*std::max_element(colour.begin(), colour.end()), 0.85);
    EXPECT_DOUBLE_EQ(*std::min_element(colour.begin(), colour.end()), 0.85 * 0.55);
  }
}

}  // namespace
}  // namespace cbc3d
