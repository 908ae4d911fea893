// The worst angle of a star as a function of its vertex's place.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <utility>

#include "mesher/improve/local/star_quality.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

/// The faces of an octahedron, each counter-clockwise seen from outside, in front of a vertex within.
Link octahedron() {
  Link link;
  for (const double x : {1.0, -1.0}) {
    for (const double y : {1.0, -1.0}) {
      for (const double z : {1.0, -1.0}) {
        std::array<Vec3, 3> face = {Vec3{x, 0, 0}, Vec3{0, y, 0}, Vec3{0, 0, z}};
        if (x * y * z < 0) std::swap(face[1], face[2]);
        link.push_back(face);
      }
    }
  }
  return link;
}

TEST(StarQuality, IsTheWorstAngleOrBelowMinusOneAndRisesWithTheVolume) {
  const Link link = octahedron();
  EXPECT_NEAR(worst_quality(link, {0, 0, 0}, -1e300), quality({0, 0, 0}, link[0]), 1e-12);
  for (const auto& face : link) {
    EXPECT_EQ(quality({0, 0, 0}, face), tet_quality({0, 0, 0}, face[0], face[1], face[2]));
    EXPECT_GT(quality({0, 0, 0}, face), 0);
  }
  double last = -1;
  for (const double far : {1.0, 1.5, 2.0, 3.0}) {  // out through a face: the farther the worse
    const double now = quality(far * Vec3{1, 1, 1}, link[0]);
    EXPECT_LT(now, last);
    last = now;
  }
}

TEST(StarQuality, TheSearchIsGivenUpBelowTheFloor) {
  const Link link = octahedron();
  std::mt19937 random(1);
  for (int n = 0; n < 100; ++n) {
    const Vec3 x = testing::draw_point(random, -0.4, 0.4);
    const double worst = worst_quality(link, x, -1e300);
    EXPECT_EQ(worst_quality(link, x, worst - 1e-9), worst);
    EXPECT_LE(worst_quality(link, x, worst + 0.1), worst + 0.1);
    double least = 1;
    for (const auto& face : link) least = std::min(least, quality(x, face));
    EXPECT_EQ(worst, least);
  }
}

TEST(StarQuality, TheWayUpLiftsTheWorstTet) {
  const Link link = octahedron();
  std::mt19937 random(2);
  for (int n = 0; n < 100; ++n) {
    const Vec3 x = testing::draw_point(random, 0.1, 0.25);  // near one face, whose tet is the worst
    const Vec3 up = steepest_ascent(link, x, 1);
    EXPECT_NEAR(up.norm(), 1, 1e-9);
    EXPECT_GT(worst_quality(link, x + 1e-3 * up, -1e300), worst_quality(link, x, -1e300));
    const auto directions = search_directions(up);
    EXPECT_EQ(directions[0], up);
    Vec3 sum;
    for (const Vec3& d : directions) sum += d;
    EXPECT_LT((sum - up).norm(), 1e-12);  // the axes both ways
  }
}

}  // namespace
}  // namespace cbc3d
