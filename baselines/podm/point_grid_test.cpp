#include "baselines/podm/point_grid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace cbc3d::baselines::podm {
namespace {

TEST(PointGrid, FindsWhatBruteForceFindsWhilePointsComeAndGo) {
  std::mt19937 random(7);
  const auto draw = [&] {
    const auto coordinate = [&] { return random() / 4294967296.0 * 20 - 10; };
    const double x = coordinate(), y = coordinate();
    return Vec3{x, y, coordinate()};
  };
  PointGrid<int> grid(3);
  std::vector<std::pair<Vec3, int>> all;
  for (int n = 0; n < 2000; ++n) {
    if (n % 3 == 2) {
      const std::size_t gone = random() % all.size();
      EXPECT_TRUE(grid.remove(all[gone].first, all[gone].second));
      EXPECT_FALSE(grid.remove(all[gone].first, all[gone].second));
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(gone));
    } else {
      all.emplace_back(draw(), n);
      grid.add(all.back().first, n);
    }
    ASSERT_EQ(grid.size(), all.size());
    const Vec3 place = draw();
    const double reach = 0.5 + random() % 100 / 20.0;
    std::set<int> found, truth;
    grid.any_within(place, reach, [&](const Vec3&, int value) {
      found.insert(value);
      return false;
    });
    for (const auto& [p, value] : all) {
      if ((p - place).norm() < reach) truth.insert(value);
    }
    ASSERT_EQ(found, truth);
  }
}

TEST(PointGrid, StopsWhereTheVisitorIsContent) {
  PointGrid<int> grid(1);
  for (int n = 0; n < 10; ++n) grid.add({0.1 * n, 0, 0}, n);
  int visits = 0;
  EXPECT_TRUE(grid.any_within({0, 0, 0}, 0.5, [&](const Vec3&, int) { return ++visits == 2; }));
  EXPECT_EQ(visits, 2);
  EXPECT_FALSE(grid.any_within({5, 5, 5}, 0.5, [](const Vec3&, int) { return true; }));
}

}  // namespace
}  // namespace cbc3d::baselines::podm
