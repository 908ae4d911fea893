// The smooth boundary that an image means, on planes, spheres, thin parts and noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d {
namespace {

using testing::draw;
using testing::kAnisotropic;
using testing::random_image;

TEST(ImageDomain, APlaneIsWhereTheVoxelsMeet) {
  std::mt19937 random(1);
  for (const Vec3& spacing : {Vec3{1, 1, 1}, kAnisotropic}) {
    for (int axis = 0; axis < 3; ++axis) {
      const double plane = 9.5 * spacing[axis];
      const LabelImage image = testing::make_image({20, 20, 20}, spacing, 2,
                                                   [&](const Vec3& p) { return p[axis] < plane ? 1 : 2; });
      const ImageDomain domain(image);
      for (int i = 0; i < 200; ++i) {
        Vec3 x = {draw(random, 6, 13) * spacing.x, draw(random, 6, 13) * spacing.y,
                  draw(random, 6, 13) * spacing.z};
        const double depth = draw(random, -3.5, 3.5) * spacing[axis];  // positive on the side of material 1
        x[axis] = plane - depth;
        const BoundaryDistance s = domain.boundary_distance(x, 1, 2);
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
        const BoundaryDistance other = domain.boundary_distance(x, 2, 1);
        EXPECT_NEAR(other.distance_mm, -s.distance_mm, 1e-9);
        EXPECT_LT((other.normal + s.normal).norm(), 1e-9);
      }
    }
  }
}

TEST(ImageDomain, ASphereIsFollowed) {
  std::mt19937 random(2);
  for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{0.8, 1, 1.3}}) {
    const Vec3 centre = {14.3, 14.1, 13.8};
    const LabelImage image = testing::make_image(
        {38, 30, 30}, spacing, 1, [&](const Vec3& p) { return (p - centre).norm() < 10 ? 1 : 0; });
    const ImageDomain domain(image);
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
      const BoundaryDistance s = domain.boundary_distance(centre + (10 - depth) * out, 1, kBackground);
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
        const BoundaryDistance s = domain.boundary_distance(x, 1, kBackground);
        ASSERT_TRUE(std::isfinite(s.deviation_mm));
        x -= s.distance_mm * s.normal;
      }
      EXPECT_NEAR((x - centre).norm(), 10, 0.6);
    }
  }
}

TEST(ImageDomain, OneVoxelPartsAndHolesKeepTheirSides) {
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
        const ImageDomain domain(image);
        const MaterialId part = hole ? 0 : 1;
        const Vec3 middle = image.frame.local_centre(5, 5, 5);
        EXPECT_GT(domain.boundary_distance(middle, part, 1 - part).distance_mm, 0) << thin_axes << hole;
        EXPECT_EQ(domain.material_at(middle), part);
        for (int axis = 0; axis < thin_axes; ++axis) {
          for (const double side : {-1.0, 1.0}) {
            Vec3 x = middle;
            x[axis] += side * spacing[axis];
            EXPECT_LT(domain.boundary_distance(x, part, 1 - part).distance_mm, 0) << thin_axes << hole;
            // The part is some tenths of a voxel thick: its boundary is crossed between the centres.
            Vec3 low = middle;
            Vec3 high = x;
            for (int step = 0; step < 40; ++step) {
              const Vec3 half = 0.5 * (low + high);
              (domain.boundary_distance(half, part, 1 - part).distance_mm > 0 ? low : high) = half;
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

TEST(ImageDomain, EveryVoxelCentreButABumpsKeepsItsMaterial) {
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    const LabelImage image =
        random_image({9, 8, 7}, seed == 1 ? Vec3{1, 1, 1} : kAnisotropic, static_cast<int>(seed), seed);
    const ImageDomain domain(image);
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      const Vec3 x = image.frame.local_centre(at[0], at[1], at[2]);
      if (domain.is_bump(at)) {
        continue;
      }
      ASSERT_EQ(domain.material_at(x), image.voxels[v]);
      for (MaterialId m = 0, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
        if (m != image.voxels[v]) {
          ASSERT_GT(domain.boundary_distance(x, image.voxels[v], m).distance_mm, 0);
        }
      }
    }
    EXPECT_EQ(domain.material_at({-50, 3, 3}), kBackground);  // outside the image
  }
}

TEST(ImageDomain, TheOutsideIsBackgroundAtHalfAVoxel) {
  const LabelImage image = testing::make_image({8, 8, 8}, {1, 1, 2}, 1, [](const Vec3&) { return 1; });
  const ImageDomain domain(image);
  const BoundaryDistance s = domain.boundary_distance({3.5, 3.5, -1}, 1, kBackground);
  EXPECT_NEAR(s.distance_mm, 0, 1e-9);
  EXPECT_LT((s.normal - Vec3{0, 0, 1}).norm(), 1e-9);
  EXPECT_EQ(domain.material_at({3.5, 3.5, -0.9}), 1);
  EXPECT_EQ(domain.material_at({3.5, 3.5, -1.1}), kBackground);
}

TEST(ImageDomain, NoBoundaryNearbyIsSaid) {
  const LabelImage image = testing::make_image({60, 12, 12}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.x > 5 && p.x < 10 ? 1 : p.x > 50 && p.x < 55 ? 2 : 0;
  });
  const ImageDomain domain(image);
  EXPECT_TRUE(std::isinf(domain.boundary_distance({30, 6, 6}, 1, kBackground).deviation_mm));
  EXPECT_TRUE(std::isinf(domain.boundary_distance({25, 6, 6}, 1, 2).deviation_mm));
  // Deep inside, the nearest voxel of the other shows the way and the sign.
  const BoundaryDistance in = domain.boundary_distance({13.2, 6, 6}, kBackground, 1);
  EXPECT_NEAR(in.distance_mm, 3.7, 0.2);
  EXPECT_GT(in.normal.x, 0.9);
}

TEST(ImageDomain, ShiftsMoveTheSurfaceOutward) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const ImageDomain domain(image);
  const Vec3 x = testing::centre_of(image) + Vec3{10, 0, 0};
  const double before = domain.boundary_distance(x, 1, kBackground).distance_mm;
  const BoundaryDistance s = domain.boundary_distance(x, 1, kBackground).shifted(0.25);
  EXPECT_NEAR(s.distance_mm, before + 0.25, 1e-12);  // deeper inside material 1 than before
  EXPECT_EQ(s.deviation_mm, std::abs(s.distance_mm));
  EXPECT_NEAR(domain.boundary_distance(x, kBackground, 1).shifted(-0.25).distance_mm, -before - 0.25, 1e-12);
  const Vec3 surface = x - s.distance_mm * s.normal;
  EXPECT_GT((surface - testing::centre_of(image)).norm(), 10 + before + 0.15);
}

/// A block of 4 voxels a side in a corner of the room, with one voxel on top and a wire of three beside it.
LabelImage block_with_bump_and_wire() {
  return testing::make_image({16, 16, 16}, {1, 1, 1}, 1, [](const Vec3& p) {
    const bool in_block = p.min_coeff() >= 4 && p.x < 8 && p.y < 8 && p.z < 8;
    const bool is_bump = p == Vec3{5, 5, 8};
    const bool in_wire = p.y == 6 && p.z == 6 && p.x >= 8 && p.x < 11;
    return in_block || is_bump || in_wire ? 1 : 0;
  });
}

TEST(ImageDomain, ABumpOfOneVoxelIsNoThinPartAndAWireIs) {
  const LabelImage image = block_with_bump_and_wire();
  const ImageDomain domain(image);
  EXPECT_TRUE(domain.is_bump({5, 5, 8}));
  EXPECT_FALSE(domain.is_thin_voxel({5, 5, 8}));
  EXPECT_FALSE(domain.is_thin_voxel({5, 5, 7}));
  for (int i = 8; i < 11; ++i) {
    EXPECT_TRUE(domain.is_thin_voxel({i, 6, 6})) << i;
    EXPECT_GT(domain.boundary_distance({static_cast<double>(i), 6, 6}, 1, kBackground).distance_mm, 0) << i;
  }
  // The smooth boundary passes below the bump's centre: it is noise.
  EXPECT_LT(domain.boundary_distance({5, 5, 8}, 1, kBackground).distance_mm, 0);
}

TEST(ImageDomain, ABridgeOfTwoVoxelsSideBySideIsThin) {
  const LabelImage image = testing::make_image({20, 12, 12}, {1, 1, 1}, 1, [](const Vec3& p) {
    const bool in_blocks = p.y > 2 && p.y < 9 && p.z > 2 && p.z < 9 && p.x > 2 && p.x < 16 && p.x != 9;
    const bool in_bridge = p.x == 9 && p.z == 5 && (p.y == 5 || p.y == 6);
    return in_blocks || in_bridge ? 1 : 0;
  });
  const ImageDomain domain(image);
  EXPECT_TRUE(domain.is_thin_voxel({9, 5, 5}));
  EXPECT_TRUE(domain.is_thin_voxel({9, 6, 5}));
}

}  // namespace
}  // namespace cbc3d
