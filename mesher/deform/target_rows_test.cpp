// Targets near a place, against a look at every one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "mesher/deform/target_rows.hpp"
#include "mesher/testing/random_draws.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(TargetRows, FindsThoseInTheBallThatAreAskedFor) {
  LabelImage image = testing::noise_image(24, 0.3, 7);
  image.frame.spacing_mm = {0.7, 1.1, 1.9};
  MaterialSets sets;
  const TargetPoints targets = extract_target_points(image, Connectivity::no, sets);
  const TargetRows rows(targets, image.frame);
  std::vector<Vec3> centres;
  for (int k = 0; k < 24; ++k) {
    for (int j = 0; j < 24; ++j) {
      const std::size_t row = image.frame.offset(0, j, k) / 24;
      for (std::uint64_t t = targets.first[row]; t < targets.first[row + 1]; ++t) {
        centres.push_back(image.frame.local_centre(targets.targets[t].i, j, k));
      }
    }
  }
  for (std::uint32_t t = 0; t < centres.size(); t += 37) EXPECT_EQ(rows.centre(t), centres[t]);
  std::mt19937 random(5);
  NearTargets near;
  std::size_t most = 0;
  for (int n = 0; n < 300; ++n) {
    const Vec3 place = testing::draw_point(random, -3, 48);
    const double radius = testing::draw(random, 0, 9);
    const auto keep = [&](const TargetPoint& target) { return target.i % 3 != n % 3; };
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t t = 0; t < centres.size(); ++t) {
      if (keep(targets.targets[t]) && (centres[t] - place).squared_norm() <= radius * radius)
        wanted.push_back(t);
    }
    rows.find(place, radius, keep, near);
    std::vector<std::uint32_t> found;
    for (std::size_t h = 0; h < near.count; ++h) {
      found.push_back(near.hits[h].target);
      EXPECT_LT((rows.to_centre(near, near.hits[h]) - (centres[found.back()] - place)).norm(), 1e-12);
    }
    EXPECT_EQ(found, wanted);  // in raster order
    most = std::max(most, found.size());
  }
  EXPECT_GT(most, 100U);
}

}  // namespace
}  // namespace cbc3d
