#include "baselines/cleaver/distance_transform.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace cbc3d::baselines::cleaver {
namespace {

TEST(DistanceTransform, AgreesWithBruteForce) {
  std::mt19937 random(5);
  for (int round = 0; round < 20; ++round) {
    CellArray<std::uint16_t> values({7, 1 + round % 9, 5}, kFarSquared);
    std::vector<Index3> sites;
    for (int n = 0; n < 1 + round / 4; ++n) {
      const Index3 at{static_cast<int>(random() % 7),
                      static_cast<int>(random() % static_cast<unsigned>(values.size[1])),
                      static_cast<int>(random() % 5)};
      sites.push_back(at);
      values.at(at[0], at[1], at[2]) = 0;
    }
    squared_distances(values);
    for (int k = 0; k < 5; ++k) {
      for (int j = 0; j < values.size[1]; ++j) {
        for (int i = 0; i < 7; ++i) {
          int least = kFarSquared;
          for (const Index3& s : sites) {
            const int x = s[0] - i, y = s[1] - j, z = s[2] - k;
            least = std::min(least, x * x + y * y + z * z);
          }
          ASSERT_EQ(values.at(i, j, k), least);
        }
      }
    }
  }
}

TEST(DistanceTransform, WithoutSitesAllIsFar) {
  CellArray<std::uint16_t> values({3, 3, 3}, kFarSquared);
  squared_distances(values);
  EXPECT_EQ(values.at(1, 1, 1), kFarSquared);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver
