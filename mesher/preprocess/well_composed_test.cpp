// Well-composed images: contacts against their definition, what is joined and what is cut, on known shapes
// and seeded noise.
#include <gtest/gtest.h>

#include "mesher/preprocess/clean_image.hpp"
#include "mesher/preprocess/well_composed.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

LabelImage empty_image(const Index3& size, int materials = 2) {
  return testing::make_image(size, {1, 1, 1}, materials, [](const Vec3&) { return 0; });
}

/// Corners and edges of voxels at which a label's closed and open sets differ: an edge at which just two
/// voxels across from each other are (or are not) of the label, a corner at which just two on a space
/// diagonal are (or are not).
std::size_t ambiguous_places(const LabelImage& image, MaterialId label) {
  std::size_t places = 0;
  const auto is_of = [&](int i, int j, int k) { return image.at_or_background(i, j, k) == label; };
  const Index3& size = image.frame.size;
  for (int k = -1; k < size[2]; ++k) {
    for (int j = -1; j < size[1]; ++j) {
      for (int i = -1; i < size[0]; ++i) {
        const bool a = is_of(i, j, k);
        const auto square = [&](const Index3& u, const Index3& w) {
          const bool b = is_of(i + u[0], j + u[1], k + u[2]);
          const bool d = is_of(i + w[0], j + w[1], k + w[2]);
          const bool c = is_of(i + u[0] + w[0], j + u[1] + w[1], k + u[2] + w[2]);
          return a == c && b == d && a != b ? 1U : 0U;
        };
        places += square({1, 0, 0}, {0, 1, 0}) + square({0, 1, 0}, {0, 0, 1}) + square({0, 0, 1}, {1, 0, 0});
        int of = 0;
        for (int c = 0; c < 8; ++c) {
          of += is_of(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) ? 1 : 0;
        }
        for (int c = 0; c < 4; ++c) {
          const bool one = is_of(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          const bool other = is_of(i + 1 - (c & 1), j + 1 - (c >> 1 & 1), k + 1 - (c >> 2));
          places += one == other && of == (one ? 2 : 6) ? 1U : 0U;
        }
      }
    }
  }
  return places;
}

std::size_t ambiguous_places(const LabelImage& image) {
  std::size_t places = 0;
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    places += ambiguous_places(image, static_cast<MaterialId>(m));
  }
  return places;
}

TEST(WellComposed, JoinsTheEdgeContactOfAWireByOneVoxel) {
  LabelImage image = empty_image({12, 12, 3});
  for (int n = 1; n < 6; ++n) {
    image.voxels[image.frame.offset(n, 3, 1)] = 1;
    image.voxels[image.frame.offset(n + 5, 4, 1)] = 1;
  }
  const ContactReport report = make_well_composed(image);
  EXPECT_EQ(report.edge_contacts, 1U);
  EXPECT_EQ(report.joined, 1U);
  EXPECT_EQ(report.cut, 0U);
  EXPECT_EQ(report.contacts_left, 0U);
  EXPECT_EQ(image.voxels_per_material()[1], 11U);
  EXPECT_EQ(split_regions(image).regions, 1U);
}

TEST(WellComposed, JoinsTheVertexContactOfAWireByAPathOfTwoVoxels) {
  LabelImage image = empty_image({12, 12, 12});
  for (int n = 1; n < 6; ++n) {
    image.voxels[image.frame.offset(n, 3, 3)] = 1;
    image.voxels[image.frame.offset(n + 5, 4, 4)] = 1;
  }
  const ContactReport report = make_well_composed(image);
  EXPECT_EQ(report.vertex_contacts, 1U);
  EXPECT_EQ(image.voxels_per_material()[1], 12U);
  EXPECT_EQ(ambiguous_places(image), 0U);
  EXPECT_EQ(split_regions(image).regions, 1U);
}

TEST(WellComposed, ResolvesContactsOfTheComplementToo) {
  LabelImage image = testing::make_image({10, 10, 10}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.min_coeff() > 0 && p.x < 9 && p.y < 9 && p.z < 9 ? 1 : 0;
  });
  image.voxels[image.frame.offset(4, 4, 4)] = 0;
  image.voxels[image.frame.offset(5, 5, 5)] = 0;  // two cavities that meet at a corner
  ASSERT_GT(ambiguous_places(image), 0U);
  EXPECT_EQ(make_well_composed(image).contacts_left, 0U);
  EXPECT_EQ(ambiguous_places(image), 0U);
}

TEST(WellComposed, LeavesAnImageWithoutContactsAsItIs) {
  LabelImage image = testing::ball_image(20, 1, 7, 3);
  ASSERT_EQ(ambiguous_places(image), 0U);
  const LabelVoxels before = image.voxels;
  EXPECT_EQ(make_well_composed(image).voxels_changed, 0U);
  EXPECT_TRUE(image.voxels == before);
}

/// Noise has no shape to keep, but what is reported must be true of it, and little may be left.
TEST(WellComposed, ReportsWhatItDidToSeededNoise) {
  for (const double density : {0.05, 0.3, 0.8}) {
    LabelImage image = testing::noise_image(20, density, 7);
    std::vector<std::size_t> voxels = image.voxels_per_material();
    const std::size_t before = ambiguous_places(image);
    const ContactReport report = make_well_composed(image);
    const std::size_t after = ambiguous_places(image);
    EXPECT_LT(after, before / 5) << density;
    EXPECT_EQ(report.contacts_left == 0, after == 0) << density;
    EXPECT_GE(report.voxels_changed, report.joined + report.cut);
    for (std::size_t m = 0; m < voxels.size(); ++m) {
      voxels[m] += static_cast<std::size_t>(report.gained[m]);
    }
    EXPECT_EQ(voxels, image.voxels_per_material());
  }
}

TEST(WellComposed, NoPartOfOneVoxelVanishes) {
  LabelImage image = testing::noise_image(16, 0.04, 3);
  const std::vector<std::size_t> before = image.voxels_per_material();
  make_well_composed(image);
  const std::vector<std::size_t> after = image.voxels_per_material();
  for (std::size_t m = 1; m < before.size(); ++m) {
    EXPECT_GE(after[m], before[m]);
  }
}

TEST(WellComposed, ACheckerboardEnds) {
  LabelImage image = testing::make_image({12, 12, 12}, {1, 1, 1}, 1, [](const Vec3& p) {
    return (static_cast<int>(p.x) + static_cast<int>(p.y) + static_cast<int>(p.z)) % 2;
  });
  const std::size_t before = ambiguous_places(image);
  make_well_composed(image);
  EXPECT_LT(ambiguous_places(image), before);
}

}  // namespace
}  // namespace cbc3d
