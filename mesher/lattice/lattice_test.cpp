// Lattice points, their places and their table.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"

namespace cbc3d {
namespace {

TEST(Lattice, FrameMapsUnitsToMillimetres) {
  const LatticeFrame frame{{10, -4, 2}, 0.25, 3};
  EXPECT_EQ(frame.local({0, 0, 0}), (Vec3{10, -4, 2}));
  EXPECT_EQ(frame.local({4, 8, 1}), (Vec3{11, -2, 2.25}));
  EXPECT_EQ(frame.spacing_mm(0), 4);
  EXPECT_EQ(frame.spacing_mm(3), 0.5);
  EXPECT_EQ(midpoint({0, 4, 10}, {2, 8, 20}), (LatticePoint{1, 6, 15}));
}

LatticePoint draw_point(std::mt19937& random) {
  const auto coordinate = [&] { return static_cast<std::int32_t>(random() % 40 * 1024); };
  return {coordinate(), coordinate(), coordinate()};
}

TEST(Lattice, TableAnswersAsAMapDoes) {
  std::mt19937 random(1);
  std::map<LatticePoint, VertexId> wanted;
  VertexTable table;
  EXPECT_EQ(table.find({1, 2, 3}), kNoVertex);
  for (int n = 0; n < 50000; ++n) {
    const LatticePoint p = draw_point(random);
    const auto next = static_cast<VertexId>(wanted.size());
    EXPECT_EQ(table.find_or_insert(p, next), wanted.try_emplace(p, next).first->second);
    const LatticePoint other = draw_point(random);
    const auto found = wanted.find(other);
    EXPECT_EQ(table.find(other), found == wanted.end() ? kNoVertex : found->second);
  }
}

TEST(Lattice, PointsThatAreClaimedTogetherGoToTheSmallestNumber) {
  std::mt19937 random(2);
  std::vector<LatticePoint> points(20000);
  for (LatticePoint& p : points) p = draw_point(random);
  std::map<LatticePoint, VertexId> first;
  for (VertexId n = 0; n < points.size(); ++n) first.try_emplace(points[n], n);
  VertexTable table;
  table.reserve(points.size());
  std::vector<std::uint32_t> slots(points.size());
#pragma omp parallel for
  for (std::size_t n = 0; n < points.size(); ++n) {
    slots[n] = table.claim(points[n], static_cast<VertexId>(n));
  }
  table.inserted(first.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    ASSERT_EQ(table.vertex_in(slots[n]), first.at(points[n]));
    ASSERT_EQ(table.find(points[n]), first.at(points[n]));
  }
}

TEST(Lattice, NewVerticesAreAppendedToTheOldOnes) {
  Lattice lattice = build_bcc_lattice(testing::ball_image(24, 1, 9), {6, 1});
  std::vector<Vec3> points = local_points(lattice);
  const std::size_t before = points.size();
  testing::refine_at_random(lattice, 1, 3, 5);
  const VertexId known = lattice.vertex_at(lattice.points[7]);
  EXPECT_EQ(known, 7U);
  points[0] = {-1, -1, -1};
  append_local_points(lattice, points);
  EXPECT_EQ(points[0], (Vec3{-1, -1, -1}));  // what is known is not computed again
  ASSERT_GT(points.size(), before);
  for (std::size_t v = 1; v < points.size(); ++v) {
    EXPECT_EQ(points[v], lattice.frame.local(lattice.points[v]));
  }
}

}  // namespace
}  // namespace cbc3d
