// Points and their vertices while vertices move and points change theirs.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "mesher/improve/surface/covered_samples.hpp"

namespace cbc3d {
namespace {

std::set<std::uint32_t> points_of(const CoveredSamples& samples, VertexId v) {
  std::set<std::uint32_t> found;
  for (std::uint32_t p = samples.first_of(v); p != CoveredSamples::kNone; p = samples.next(p))
    found.insert(p);
  return found;
}

TEST(CoveredSamples, ListsFollowThePointsThatMove) {
  const std::vector<InterfacePoint> points(6, {{0, 0, 0}, 1, 0});
  std::vector<VertexId> hosts = {2, 0, 2, kNoVertex, 2, 1};
  CoveredSamples samples(points, hosts, 4, 1);
  std::mt19937 random(1);
  for (int step = 0; step < 200; ++step) {
    for (VertexId v = 0; v < 4; ++v) {
      std::set<std::uint32_t> wanted;
      for (std::uint32_t p = 0; p < hosts.size(); ++p) {
        if (hosts[p] == v) wanted.insert(p);
      }
      ASSERT_EQ(points_of(samples, v), wanted);
    }
    const std::uint32_t p = random() % 6;
    if (hosts[p] != kNoVertex) samples.move_point(p, random() % 4);
  }
}

TEST(CoveredSamples, AVertexMayGoWhereItsPointsStayWithinReachOrComeNearer) {
  const std::vector<InterfacePoint> points = {{{0, 0, 0}, 1, 0}, {{3, 0, 0}, 1, 0}};
  std::vector<VertexId> hosts = {0, 1};
  const CoveredSamples samples(points, hosts, 3, 1);
  EXPECT_TRUE(samples.allow(0, {0, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(samples.allow(0, {0, 0, 0}, {0, 1.01, 0}));
  EXPECT_TRUE(samples.allow(2, {0, 0, 0}, {9, 9, 9}));  // it has no points
  // Vertex 1 was beyond the reach: it may not go farther.
  EXPECT_EQ(samples.limit_squared(1, {3, 0, 2}), 4);
  EXPECT_EQ(samples.limit_squared(1, {3, 0, 0.5}), 1);
  EXPECT_TRUE(samples.allow(1, {3, 0, 2}, {3, 1.9, 0}));
  EXPECT_FALSE(samples.allow(1, {3, 0, 2}, {3, 2.1, 0}));
}

}  // namespace
}  // namespace cbc3d
