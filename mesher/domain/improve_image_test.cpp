// What the improver asks of an image: its smooth boundary, its boundary voxels and their hosts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "mesher/domain/coverage.hpp"
#include "mesher/domain/image_boundary.hpp"
#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

double draw(std::mt19937& random, double low, double high) {
  return low + (high - low) * (random() / 4294967296.0);
}
Vec3 draw_in(std::mt19937& random, const ImageFrame& frame, double margin_mm) {
  Vec3 x;
  for (int axis = 0; axis < 3; ++axis) {
    const double end = (frame.size[static_cast<std::size_t>(axis)] - 1) * frame.spacing_mm[axis];
    x[axis] = draw(random, -margin_mm, end + margin_mm);
  }
  return x;
}

/// Materials drawn voxel by voxel, up to the image's border.
LabelImage random_image(const Index3& size, const Vec3& spacing_mm, int materials, std::uint32_t seed) {
  std::mt19937 random(seed);
  return testing::make_image(size, spacing_mm, materials, [&](const Vec3&) {
    return static_cast<int>(random() % static_cast<unsigned>(materials + 1));
  });
}

const Vec3 kAnisotropic = {0.7, 1.1, 1.9};

// ---- the boundary

TEST(ImageBoundary, APlaneIsWhereTheVoxelsMeet) {
  std::mt19937 random(1);
  for (const Vec3& spacing : {Vec3{1, 1, 1}, kAnisotropic}) {
    for (int axis = 0; axis < 3; ++axis) {
      const double plane = 9.5 * spacing[axis];
      const LabelImage image = testing::make_image({20, 20, 20}, spacing, 2,
                                                   [&](const Vec3& p) { return p[axis] < plane ? 1 : 2; });
      const ImageBoundary boundary(image, {});
      for (int i = 0; i < 200; ++i) {
        Vec3 x = {draw(random, 6, 13) * spacing.x, draw(random, 6, 13) * spacing.y,
                  draw(random, 6, 13) * spacing.z};
        const double depth = draw(random, -3.5, 3.5) * spacing[axis];  // positive on the side of material 1
        x[axis] = plane - depth;
        const BoundarySample s = boundary.sample(x, 1, 2);
        Vec3 towards_1;
        towards_1[axis] = -1;
        // Farther away it is the way to the nearest voxel's centre.
        EXPECT_LT((s.normal - towards_1).norm(), std::abs(depth) < spacing[axis] ? 1e-9 : 0.7);
        EXPECT_GE(s.distance_mm * depth, 0);
        EXPECT_EQ(s.deviation_mm, std::abs(s.distance_mm));
        if (std::abs(depth) <= 0.5 * spacing[axis]) {
          const double voxel = std::cbrt(spacing.x * spacing.y * spacing.z);
          // The floor under the slope scales the distance along the longest axis of such voxels, no more.
          const double exact = depth * std::min(1.0, 2 * voxel / spacing[axis]);
          EXPECT_NEAR(s.distance_mm, exact, 1e-9);
        } else {
          EXPECT_GT(s.deviation_mm, 0.45 * spacing[axis]);
        }
        const BoundarySample other = boundary.sample(x, 2, 1);
        EXPECT_NEAR(other.distance_mm, -s.distance_mm, 1e-9);
        EXPECT_LT((other.normal + s.normal).norm(), 1e-9);
      }
    }
  }
}

TEST(ImageBoundary, ASphereIsFollowed) {
  std::mt19937 random(2);
  for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{0.8, 1, 1.3}}) {
    const Vec3 centre = {14.3, 14.1, 13.8};
    const LabelImage image = testing::make_image(
        {38, 30, 30}, spacing, 1, [&](const Vec3& p) { return (p - centre).norm() < 10 ? 1 : 0; });
    const ImageBoundary boundary(image, {});
    double farthest = 0;
    double sum = 0;
    double sum_unsigned = 0;
    constexpr int kSamples = 4000;
    for (int i = 0; i < kSamples; ++i) {
      Vec3 out;
      do {
        out = {draw(random, -1, 1), draw(random, -1, 1), draw(random, -1, 1)};
      } while (out.norm() > 1 || out.norm() < 0.1);
      out = out.normalized();
      const double depth = draw(random, -0.4, 0.4);
      const BoundarySample s = boundary.sample(centre + (10 - depth) * out, 1, kBackground);
      farthest = std::max(farthest, std::abs(s.distance_mm - depth));
      sum += s.distance_mm - depth;
      sum_unsigned += std::abs(s.distance_mm - depth);
      EXPECT_LT(s.normal.dot(out), -0.6);  // towards material 1, inwards
      EXPECT_NEAR(s.normal.norm(), 1, 1e-9);
    }
    // Half a voxel beyond the surface the field's slope halves, and the estimate gains up to half a voxel.
    EXPECT_LT(farthest, 1.1);
    EXPECT_LT(sum_unsigned / kSamples, 0.2);
    EXPECT_LT(std::abs(sum / kSamples), 0.1);
    // A step against the sampled distance from afar ends near the sphere.
    for (const double r : {7.0, 8.5, 11.5, 13.0}) {
      Vec3 x = centre + Vec3{0.6 * r, 0, 0.8 * r};
      for (int step = 0; step < 20; ++step) {
        const BoundarySample s = boundary.sample(x, 1, kBackground);
        ASSERT_TRUE(std::isfinite(s.deviation_mm));
        x -= s.distance_mm * s.normal;
      }
      EXPECT_NEAR((x - centre).norm(), 10, 0.6);
    }
  }
}

TEST(ImageBoundary, OneVoxelPartsAndHolesKeepTheirSides) {
  // A sheet, a line, a single voxel, each once of material in background and once the other way round.
  for (const Vec3& spacing : {Vec3{1, 1, 1}, kAnisotropic}) {
    for (int thin_axes = 1; thin_axes <= 3; ++thin_axes) {
      for (const bool hole : {false, true}) {
        const auto is_part = [&](const Index3& at) {
          return at[0] == 5 && (thin_axes < 2 || at[1] == 5) && (thin_axes < 3 || at[2] == 5);
        };
        LabelImage image = testing::make_image({11, 11, 11}, spacing, 1, [](const Vec3&) { return 0; });
        for (std::size_t v = 0; v < image.voxels.size(); ++v) {
          image.voxels[v] = is_part(image.frame.index_of(v)) != hole ? 1 : 0;
        }
        const ImageBoundary boundary(image, {});
        const MaterialId part = hole ? 0 : 1;
        const Vec3 middle = image.frame.local_centre(5, 5, 5);
        EXPECT_GT(boundary.sample(middle, part, 1 - part).distance_mm, 0) << thin_axes << hole;
        EXPECT_EQ(boundary.material_at(middle), part);
        for (int axis = 0; axis < thin_axes; ++axis) {
          for (const double side : {-1.0, 1.0}) {
            Vec3 x = middle;
            x[axis] += side * spacing[axis];
            EXPECT_LT(boundary.sample(x, part, 1 - part).distance_mm, 0) << thin_axes << hole;
            // The part is some tenths of a voxel thick: its boundary is crossed between the centres.
            Vec3 low = middle;
            Vec3 high = x;
            for (int step = 0; step < 40; ++step) {
              const Vec3 half = 0.5 * (low + high);
              (boundary.sample(half, part, 1 - part).distance_mm > 0 ? low : high) = half;
            }
            const double thickness = std::abs(low[axis] - middle[axis]) / spacing[axis];
            EXPECT_GT(thickness, 0.2);
            EXPECT_LT(thickness, 0.8);
          }
        }
      }
    }
  }
}

TEST(ImageBoundary, EveryVoxelCentreKeepsItsMaterial) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const LabelImage image =
        random_image({9, 8, 7}, seed == 1 ? Vec3{1, 1, 1} : kAnisotropic, static_cast<int>(seed), seed);
    const ImageBoundary boundary(image, {});
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      const Vec3 x = image.frame.local_centre(at[0], at[1], at[2]);
      ASSERT_EQ(boundary.material_at(x), image.voxels[v]);
      for (MaterialId m = 0, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
        if (m != image.voxels[v]) {
          ASSERT_GT(boundary.sample(x, image.voxels[v], m).distance_mm, 0);
        }
      }
    }
    EXPECT_EQ(boundary.material_at({-50, 3, 3}), kBackground);  // outside the image
  }
}

TEST(ImageBoundary, TheOutsideIsBackgroundAtHalfAVoxel) {
  const LabelImage image = testing::make_image({8, 8, 8}, {1, 1, 2}, 1, [](const Vec3&) { return 1; });
  const ImageBoundary boundary(image, {});
  const BoundarySample s = boundary.sample({3.5, 3.5, -1}, 1, kBackground);
  EXPECT_NEAR(s.distance_mm, 0, 1e-9);
  EXPECT_LT((s.normal - Vec3{0, 0, 1}).norm(), 1e-9);
  EXPECT_EQ(boundary.material_at({3.5, 3.5, -0.9}), 1);
  EXPECT_EQ(boundary.material_at({3.5, 3.5, -1.1}), kBackground);
}

TEST(ImageBoundary, NoBoundaryNearbyIsSaid) {
  const LabelImage image = testing::make_image({60, 12, 12}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.x > 5 && p.x < 10 ? 1 : p.x > 50 && p.x < 55 ? 2 : 0;
  });
  const ImageBoundary boundary(image, {});
  EXPECT_TRUE(std::isinf(boundary.sample({30, 6, 6}, 1, kBackground).deviation_mm));
  EXPECT_TRUE(std::isinf(boundary.sample({25, 6, 6}, 1, 2).deviation_mm));
  // Deep inside, the nearest voxel of the other shows the way and the sign.
  const BoundarySample in = boundary.sample({13.2, 6, 6}, kBackground, 1);
  EXPECT_NEAR(in.distance_mm, 3.7, 0.2);
  EXPECT_GT(in.normal.x, 0.9);
}

TEST(ImageBoundary, OffsetsMoveTheSurfaceOutward) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  ImageBoundary boundary(image, {});
  const Vec3 x = testing::centre_of(image) + Vec3{10, 0, 0};
  const double before = boundary.sample(x, 1, kBackground).distance_mm;
  boundary.set_offsets({0, 0.25});
  const BoundarySample s = boundary.sample(x, 1, kBackground);
  EXPECT_NEAR(s.distance_mm, before + 0.25, 1e-12);  // deeper inside material 1 than before
  EXPECT_EQ(s.deviation_mm, std::abs(s.distance_mm));
  EXPECT_NEAR(boundary.sample(x, kBackground, 1).distance_mm, -before - 0.25, 1e-12);
  const Vec3 surface = x - s.distance_mm * s.normal;
  EXPECT_GT((surface - testing::centre_of(image)).norm(), 10 + before + 0.15);
}

// ---- boundary voxels and hosts

TEST(InterfacePoints, AreThoseOfTheFaceNeighbours) {
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
    const auto points = interface_points(image);
    for (const InterfacePoint& p : points) {
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

double nearest_by_brute_force(const InterfacePoint& p, const Vertices& vertices, double reach_mm) {
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

TEST(InterfacePoints, HostsThatAreKeptHideNothing) {
  const LabelImage image = random_image({8, 7, 6}, kAnisotropic, 2, 9);
  const auto points = interface_points(image);
  Vertices vertices = draw_vertices(image, 150, 9);
  std::vector<VertexId> hosts;
  std::size_t changes = 0;
  auto before = renew_hosts(points, vertices.points, vertices.sets, 1.5, hosts);
  for (std::size_t step = 0; step < 20; ++step) {
    vertices.sets[7 * step] = vertices.sets[(31 * step + 5) % vertices.sets.size()];
    const auto without = renew_hosts(points, vertices.points, vertices.sets, 1.5, hosts);
    EXPECT_EQ(without, points_without_host(points, vertices.points, vertices.sets, 1.5));
    changes += without != before ? 1 : 0;
    before = without;
  }
  EXPECT_GT(changes, 0U);
}

TEST(InterfacePoints, HostsAreTheNearestVerticesOfTheirInterface) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    const LabelImage image = random_image({8, 7, 6}, kAnisotropic, 2, seed);
    const auto points = interface_points(image);
    const Vertices vertices = draw_vertices(image, 150, seed);
    const double reach = 0.6 + 0.5 * seed;
    const auto hosts = nearest_hosts(points, vertices.points, vertices.sets, reach);
    const auto without = points_without_host(points, vertices.points, vertices.sets, reach);
    std::vector<std::size_t> expected_without;
    ASSERT_EQ(hosts.size(), points.size());
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double nearest = nearest_by_brute_force(points[p], vertices, reach);
      if (std::isinf(nearest)) {
        expected_without.push_back(p);
        EXPECT_EQ(hosts[p], kNoVertex);
      } else {
        ASSERT_NE(hosts[p], kNoVertex);
        EXPECT_TRUE(points[p].is_on(vertices.sets[hosts[p]]));
        EXPECT_NEAR((vertices.points[hosts[p]] - points[p].centre()).norm(), nearest, 1e-9);
      }
    }
    EXPECT_EQ(without, expected_without);
    EXPECT_GT(without.size(), 0U);
    EXPECT_LT(without.size(), points.size());
    InterfaceCoverage coverage(image);
    coverage.update(vertices.sets, vertices.points, reach);
    EXPECT_EQ(coverage.uncovered_count(), without.size());
    // Wanted are the voxels of points without host, and those across the interface from them.
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

TEST(InterfacePoints, MaterialsOfASetMeetNearOrNot) {
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
    EXPECT_EQ(all_meet_near(image, x, set, reach), expected);
    met += expected ? 1 : 0;
  }
  EXPECT_GT(met, 50);
  EXPECT_LT(met, 250);
}

TEST(InterfaceCoverage, AClosedGapBetweenTwoLabelsIsSeen) {
  // Two slabs one voxel apart. Vertices in the gap where both labels meet cover each label's boundary; the
  // interfaces towards background are missing all the same.
  const LabelImage image = testing::make_image({9, 5, 5}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.x < 4 ? 1 : p.x > 4 ? 2 : 0;
  });
  Vertices closed;
  Vertices open;
  for (int j = 0; j < 5; ++j) {
    for (int k = 0; k < 5; ++k) {
      closed.points.push_back({4.0, static_cast<double>(j), static_cast<double>(k)});
      closed.sets.emplace_back();
      closed.sets.back().add(1);
      closed.sets.back().add(2);
    }
  }
  open.points = closed.points;
  open.sets = closed.sets;
  for (MaterialSet& set : open.sets) set.add(kBackground);
  InterfaceCoverage coverage(image);
  coverage.update(open.sets, open.points, 1.1);
  const std::size_t elsewhere = coverage.uncovered_count();  // on the image's border
  EXPECT_FALSE(coverage.wants_refinement(2, 2, 3, 6));
  coverage.update(closed.sets, closed.points, 1.1);
  EXPECT_GT(coverage.uncovered_count(), elsewhere);
  EXPECT_TRUE(coverage.wants_refinement(2, 2, 3, 4));
  EXPECT_TRUE(coverage.wants_refinement(2, 2, 4, 5));
}

TEST(SurfaceCover, PointsGoToHostsWithinReachOrStay) {
  const std::vector<InterfacePoint> points = {{{0, 0, 0}, 1, 0}, {{1, 0, 0}, 1, 0}};
  const TetComplex mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {1}, {0, 0, 0, 0});
  std::vector<MaterialSet> sets(4);
  for (MaterialSet& set : sets) {
    set.add(0);
    set.add(1);
  }
  const auto points_of = [](const SurfaceCover& cover, VertexId v) {
    std::set<PointId> found;
    cover.for_each(v, [&](PointId p) { found.insert(p); });
    return found;
  };
  SurfaceCover cover(points, 1.05);
  cover.resize(4);
  cover.add(0, 0);
  cover.add(0, 1);
  const std::array<VertexId, 1> far = {2};
  const std::array<VertexId, 2> near = {2, 1};
  const Vec3 step = {0, 0, 0.2};
  const Vec3 away = {-0.5, 0, 0};
  EXPECT_FALSE(cover.can_release(0, nullptr, far, mesh, sets));  // point 1 is 1.4 from vertex 2
  EXPECT_TRUE(cover.can_release(0, &step, {}, mesh, sets));
  cover.commit(0);
  EXPECT_EQ(points_of(cover, 0), (std::set<PointId>{0, 1}));
  EXPECT_FALSE(cover.can_release(0, &away, far, mesh, sets));
  ASSERT_TRUE(cover.can_release(0, &away, near, mesh, sets));
  cover.commit(0);
  EXPECT_EQ(points_of(cover, 0), (std::set<PointId>{0}));
  EXPECT_EQ(points_of(cover, 1), (std::set<PointId>{1}));
  sets[1] = {};  // not on the interface any more: no host
  EXPECT_FALSE(cover.can_release(0, nullptr, std::array<VertexId, 1>{1}, mesh, sets));
  sets[2] = {};
  EXPECT_FALSE(cover.can_release(0, nullptr, near, mesh, sets));
}

TEST(SurfaceCover, WhatNoneAroundReachesIsStrandedAndGoesToTheOneThatStays) {
  // A row of points; vertices 0 and 1 become one, 2 and 3 are to their left and right.
  std::vector<InterfacePoint> points;
  points.reserve(7);
  for (int i = 0; i < 7; ++i) points.push_back({{1.0F * static_cast<float>(i), 0, 0}, 1, 0});
  const TetComplex mesh({{2, 0, 0}, {4, 0, 0}, {0, 0, 0}, {6, 0, 0}}, {}, {}, {0, 0, 0, 0});
  std::vector<MaterialSet> sets(4);
  for (MaterialSet& set : sets) {
    set.add(0);
    set.add(1);
  }
  SurfaceCover cover(points, 1.1);
  cover.resize(4);
  for (const PointId p : {1U, 2U, 3U}) cover.add(0, p);
  for (const PointId p : {4U, 5U}) cover.add(1, p);
  const std::array<VertexId, 2> others = {2, 3};
  EXPECT_TRUE(cover.find_stranded(0, 1, others, mesh, sets));
  EXPECT_EQ(std::set<PointId>(cover.stranded().begin(), cover.stranded().end()),
            (std::set<PointId>{2, 3, 4}));
  cover.commit_merge(0, 1);
  const std::array<std::set<PointId>, 4> expected = {{{}, {2, 3, 4}, {1}, {5}}};
  for (VertexId v = 0; v < 4; ++v) {
    std::set<PointId> found;
    cover.for_each(v, [&](PointId p) { found.insert(p); });
    EXPECT_EQ(found, expected[v]) << v;
  }
  sets[2] = {};                                                                     // no host any more
  EXPECT_FALSE(cover.find_stranded(2, 3, std::array<VertexId, 1>{2}, mesh, sets));  // they are 4 apart
}

}  // namespace
}  // namespace cbc3d
