#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cases/phantoms/generators.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/preprocess/voxel_contacts.hpp"

namespace cbc3d::cases {
namespace {

constexpr Index3 kSize{32, 32, 32};
constexpr Vec3 kSpacing{1, 1, 1};
constexpr std::uint64_t kImages = 60;

bool same_voxels(const LabelImage& a, const LabelImage& b) {
  if (a.frame.size != b.frame.size) return false;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    if (a.voxels[v] != b.voxels[v]) return false;
  }
  return true;
}

TEST(AssortedPhantom, EverySeedGivesALabelWithinTheSizeAndTheSpacing) {
  for (std::uint64_t seed = 0; seed < kImages; ++seed) {
    const LabelImage image = assorted_phantom(kSize, kSpacing, seed);
    const auto voxels = image.voxels_per_material();
    EXPECT_LT(voxels[0], image.voxels.size()) << seed;
    for (std::size_t a = 0; a < 3; ++a) {
      EXPECT_GE(image.frame.size[a], 16) << seed;
      EXPECT_LE(image.frame.size[a], kSize[a]) << seed;
      EXPECT_GE(image.frame.spacing_mm[static_cast<int>(a)], 1) << seed;
    }
    EXPECT_NEAR(std::abs(image.frame.direction.determinant()), 1, 1e-12) << seed;
    EXPECT_TRUE(std::is_sorted(image.labels.begin(), image.labels.end())) << seed;
  }
}

TEST(AssortedPhantom, FramesVoxelsAndLabelsAreOfAllSorts) {
  int oblique = 0, left_handed = 0, uneven = 0, with_gaps = 0;
  std::set<std::size_t> label_counts;
  for (std::uint64_t seed = 0; seed < kImages; ++seed) {
    const LabelImage image = assorted_phantom(kSize, kSpacing, seed);
    oblique += image.frame.direction == Mat3::identity() ? 0 : 1;
    left_handed += image.frame.left_handed() ? 1 : 0;
    uneven += image.frame.spacing_mm.max_coeff() > 1 ? 1 : 0;
    with_gaps += image.labels.back() > static_cast<Label>(image.labels.size()) ? 1 : 0;
    label_counts.insert(image.labels.size() - 1);
  }
  EXPECT_GT(oblique, 8);
  EXPECT_GT(left_handed, 0);
  EXPECT_GT(uneven, 15);
  EXPECT_GT(with_gaps, 10);
  EXPECT_GT(label_counts.size(), 5U);
}

TEST(AssortedPhantom, NearlyNoContactIsLeft) {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < kImages; ++seed) {
    const ContactReport report = count_voxel_contacts(assorted_phantom(kSize, kSpacing, seed));
    contacts += report.edge_contacts + report.vertex_contacts;
  }
  EXPECT_LT(contacts, kImages);
}

TEST(AssortedPhantom, ASeedGivesTheSameVoxelsAtAnyThreadCount) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    set_thread_count(1);
    const LabelImage one = assorted_phantom(kSize, kSpacing, seed);
    set_thread_count(3);
    EXPECT_TRUE(same_voxels(one, assorted_phantom(kSize, kSpacing, seed))) << seed;
    EXPECT_FALSE(same_voxels(one, assorted_phantom(kSize, kSpacing, seed + 10))) << seed;
  }
}

}  // namespace
}  // namespace cbc3d::cases
