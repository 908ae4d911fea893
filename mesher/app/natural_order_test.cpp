#include "mesher/app/natural_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace cbc3d {
namespace {

TEST(NaturalOrder, NumbersCountAsNumbers) {
  const std::vector<std::string> ordered = {
      "a", "a0", "a00", "a1b2", "a1b10", "a2", "a02", "a10", "a99999999999999999998", "a99999999999999999999",
      "b1"};
  for (std::size_t a = 0; a < ordered.size(); ++a) {
    for (std::size_t b = 0; b < ordered.size(); ++b) {
      EXPECT_EQ(comes_before(ordered[a], ordered[b]), a < b) << ordered[a] << ' ' << ordered[b];
    }
  }
}

TEST(NaturalOrder, IsAnOrderOfRandomNames) {
  std::mt19937 random(5);
  std::vector<std::string> names;
  for (int n = 0; n < 60; ++n) {
    std::string name;
    for (unsigned k = random() % 6; k > 0; --k) {
      name += "019ab."[random() % 6];
    }
    names.push_back(name);
  }
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      EXPECT_EQ(comes_before(a, b) || comes_before(b, a), a != b) << a << ' ' << b;
      for (const std::string& c : names) {
        EXPECT_FALSE(comes_before(a, b) && comes_before(b, c) && !comes_before(a, c))
            << a << ' ' << b << ' ' << c;
      }
    }
  }
}

}  // namespace
}  // namespace cbc3d
