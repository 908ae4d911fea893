// Vectors whose new elements are left alone, and values that are given are kept.
#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "mesher/core/uninitialized_vector.hpp"

namespace cbc3d {
namespace {

int constructed = 0;
struct Counted {
  Counted() : value(1) { ++constructed; }
  int value;
};

TEST(UninitializedVector, GivenValuesAreKept) {
  UninitializedVector<int> values(3, 9);
  values.push_back(4);
  values.resize(1000000);
  EXPECT_EQ(std::vector<int>(values.begin(), values.begin() + 4), (std::vector<int>{9, 9, 9, 4}));
  values.assign(5, 2);
  EXPECT_EQ(values, (UninitializedVector<int>{2, 2, 2, 2, 2}));
  const UninitializedVector<std::pair<int, double>> pairs(2, {1, 2.5});
  EXPECT_EQ(pairs[1].second, 2.5);
}

TEST(UninitializedVector, ConstructorsOfTheElementsRun) {
  constructed = 0;
  UninitializedVector<Counted> values(3);
  values.resize(5);
  EXPECT_EQ(constructed, 5);
  EXPECT_EQ(values[4].value, 1);
}

}  // namespace
}  // namespace cbc3d
