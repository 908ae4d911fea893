// Boundary samples and the vertices that cover them, against searches through all voxels and vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include "mesher/domain/boundary_samples.hpp"
#include "mesher/domain/coverage.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d {
namespace {

using testing::draw;
using testing::draw_in;
using testing::kAnisotropic;
using testing::random_image;

TEST(BoundarySamples, AreThoseOfTheFaceNeighbours) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const LabelImage image = random_image({7, 6, 5}, kAnisotropic, 3, seed);
    std::set<std::array<int, 3>> expected;  // voxel, own, other
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Index3 to = at;
          to[axis] += step;
          const MaterialId other = image.at_or_background(to[0], to[1], to[2]);
          if (image.voxels[v] != kBackground && other != image.voxels[v]) {
            expected.insert({static_cast<int>(v), image.voxels[v], other});
          }
        }
      }
    }
    std::set<std::array<int, 3>> found;
    std::size_t last = 0;
    const auto points = boundary_samples(image);
    for (const BoundarySample& p : points) {
      const Vec3 c = p.centre();
      const auto index = [&](int axis) {
        return static_cast<int>(std::lround(c[axis] / image.frame.spacing_mm[axis]));
      };
      const std::size_t v = image.frame.offset(index(0), index(1), index(2));
      EXPECT_LT((c - image.frame.local_centre(index(0), index(1), index(2))).norm(), 1e-5);
      EXPECT_GE(v, last);  // in the order of the voxels
      last = v;
      found.insert({static_cast<int>(v), p.own, p.other});
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(points.size(), expected.size());  // each once
  }
}

struct Vertices {
  std::vector<Vec3> points;
  std::vector<MaterialSet> sets;
};

Vertices draw_vertices(const LabelImage& image, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  Vertices vertices;
  for (std::size_t v = 0; v < count; ++v) {
    vertices.points.push_back(draw_in(random, image.frame, 1.5));
    MaterialSet set;
    for (MaterialId m = 0, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
      if (random() % 2 == 0) set.add(m);
    }
    vertices.sets.push_back(set);
  }
  return vertices;
}

double nearest_by_brute_force(const BoundarySample& p, const Vertices& vertices, double reach_mm) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < vertices.points.size(); ++v) {
    const MaterialSet& set = vertices.sets[v];
    const bool own = std::count(set.ids.begin(), set.ids.begin() + set.size, p.own) > 0;
    const bool other = std::count(set.ids.begin(), set.ids.begin() + set.size, p.other) > 0;
    const double d = (vertices.points[v] - p.centre()).norm();
    if (own && other && d <= reach_mm) nearest = std::min(nearest, d);
  }
  return nearest;
}

TEST(BoundarySamples, VerticesThatStillCoverHideNothing) {
  const LabelImage image = random_image({8, 7, 6}, kAnisotropic, 2, 9);
  const auto points = boundary_samples(image);
  Vertices vertices = draw_vertices(image, 150, 9);
  std::vector<VertexId> covering;
  std::size_t changes = 0;
  auto before = renew_covering_vertices(points, vertices.points, vertices.sets, 1.5, covering);
  for (std::size_t step = 0; step < 20; ++step) {
    vertices.sets[7 * step] = vertices.sets[(31 * step + 5) % vertices.sets.size()];
    const auto without = renew_covering_vertices(points, vertices.points, vertices.sets, 1.5, covering);
    EXPECT_EQ(without, uncovered_samples(points, vertices.points, vertices.sets, 1.5));
    changes += without != before ? 1 : 0;
    before = without;
  }
  EXPECT_GT(changes, 0U);
}

TEST(BoundarySamples, CoveringVerticesAreTheNearestOfTheirInterface) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    const LabelImage image = random_image({8, 7, 6}, kAnisotropic, 2, seed);
    const auto points = boundary_samples(image);
    const Vertices vertices = draw_vertices(image, 150, seed);
    const double reach = 0.6 + 0.5 * seed;
    const auto covering = nearest_covering_vertices(points, vertices.points, vertices.sets, reach);
    const auto without = uncovered_samples(points, vertices.points, vertices.sets, reach);
    std::vector<std::size_t> expected_without;
    ASSERT_EQ(covering.size(), points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double nearest = nearest_by_brute_force(points[p], vertices, reach);
      if (std::isinf(nearest)) {
        expected_without.push_back(p);
        EXPECT_EQ(covering[p], kNoVertex);
      } else {
        ASSERT_NE(covering[p], kNoVertex);
        EXPECT_TRUE(points[p].is_on(vertices.sets[covering[p]]));
        EXPECT_NEAR((vertices.points[covering[p]] - points[p].centre()).norm(), nearest, 1e-9);
      }
    }
    EXPECT_EQ(without, expected_without);
    EXPECT_GT(without.size(), 0U);
    EXPECT_LT(without.size(), points.size());
    const ImageDomain domain(image);
    InterfaceCoverage coverage(domain);
    coverage.update(vertices.sets, vertices.points, reach);
    EXPECT_EQ(coverage.uncovered_count(), without.size());
    // Wanted are the voxels of uncovered samples, and those across the interface from them.
    std::set<std::size_t> wanted;
    for (const std::size_t p : without) {
      const Vec3 c = points[p].centre();
      Index3 at;
      for (int a = 0; a < 3; ++a)
        at[static_cast<std::size_t>(a)] = static_cast<int>(std::lround(c[a] / image.frame.spacing_mm[a]));
      wanted.insert(image.frame.offset(at[0], at[1], at[2]));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Index3 to = at;
          to[axis] += step;
          if (image.frame.contains(to[0], to[1], to[2]) && image.at(to[0], to[1], to[2]) == points[p].other) {
            wanted.insert(image.frame.offset(to[0], to[1], to[2]));
          }
        }
      }
    }
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      EXPECT_EQ(coverage.wants_refinement(at[1], at[2], at[0], at[0] + 1), wanted.count(v) > 0);
    }
  }
}

TEST(BoundarySamples, MaterialsOfASetMeetNearOrNot) {
  std::mt19937 random(7);
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    // Sparse, so that not everything meets everywhere.
    const LabelImage image = testing::make_image({7, 7, 7}, kAnisotropic, 2, [&](const Vec3&) {
      const auto roll = random() % 40;
      return roll == 0 ? 1 : roll < 3 ? 2 : 0;
    });
    const Vec3 x = draw_in(random, image.frame, 0);
    const double reach = draw(random, 0.4, 2.5);
    MaterialSet set;
    for (MaterialId m = 0; m < 3; ++m) {
      if (random() % 4 != 0) set.add(m);
    }
    // Cells of eight voxel centres that the cube of the reach round x touches.
    std::set<std::array<MaterialId, 2>> pairs;
    for (int cell = 0; cell < 9 * 9 * 9; ++cell) {
      const Index3 low = {cell % 9 - 1, cell / 9 % 9 - 1, cell / 81 - 1};
      bool touched = true;
      for (int a = 0; a < 3; ++a) {
        const double from = low[static_cast<std::size_t>(a)] * image.frame.spacing_mm[a];
        touched = touched && x[a] + reach >= from && x[a] - reach < from + image.frame.spacing_mm[a];
      }
      for (int c = 0; touched && c < 64; ++c) {
        pairs.insert(
            {image.at_or_background(low[0] + (c & 1), low[1] + (c >> 1 & 1), low[2] + (c >> 2 & 1)),
             image.at_or_background(low[0] + (c >> 3 & 1), low[1] + (c >> 4 & 1), low[2] + (c >> 5))});
      }
    }
    bool expected = true;
    for (std::uint8_t s = 0; s < set.size; ++s) {
      for (std::uint8_t r = 0; r < set.size; ++r) {
        expected = expected && pairs.count({set.ids[s], set.ids[r]}) > 0;
      }
    }
    EXPECT_EQ(ImageDomain(image).all_meet_near(x, set, reach), expected);
    met += expected ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 250);
}

}  // namespace
}  // namespace cbc3d
