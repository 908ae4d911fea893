// Image pre-processing against independent checks on seeded noise.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <queue>

#include "mesher/preprocess/clean_image.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

LabelImage empty_image(const Index3& size, int materials = 2) {
  return testing::make_image(size, {1, 1, 1}, materials, [](const Vec3&) { return 0; });
}

/// Contacts by the definition: every pair of voxels of one label that share exactly an edge or a vertex, and
/// no voxel of the label in the smallest block that holds both.
std::size_t contacts_by_definition(const LabelImage& image) {
  std::size_t contacts = 0;
  const auto& size = image.frame.size;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const MaterialId m = image.at(i, j, k);
        for (int step = 0; step < 27 && m != 0; ++step) {
          const Index3 d = {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
          const int steps = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
          if (steps < 2 || step < 14 || image.at_or_background(i + d[0], j + d[1], k + d[2]) != m) {
            continue;
          }
          int same = 0;
          for (int part = 0; part < 8; ++part) {
            const Index3 o = {(part & 1) != 0 ? d[0] : 0, (part & 2) != 0 ? d[1] : 0,
                              (part & 4) != 0 ? d[2] : 0};
            same += image.at_or_background(i + o[0], j + o[1], k + o[2]) == m ? 1 : 0;
          }
          contacts += same == 2 * (8 >> steps) ? 1 : 0;  // a square is met twice among the eight parts
        }
      }
    }
  }
  return contacts;
}

/// Number of face-connected components of labelled voxels with the same label value.
std::size_t components(const LabelImage& image) {
  std::vector<std::uint8_t> seen(image.voxels.size(), 0);
  std::size_t count = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (image.voxels[start] == 0 || seen[start] != 0) continue;
    ++count;
    std::queue<std::size_t> queue({start});
    seen[start] = 1;
    while (!queue.empty()) {
      const Index3 at = image.frame.index_of(queue.front());
      const Label label = image.labels[image.voxels[queue.front()]];
      queue.pop();
      for (int n = 0; n < 6; ++n) {
        Index3 next = at;
        next[static_cast<std::size_t>(n / 2)] += n % 2 == 0 ? -1 : 1;
        if (image.frame.contains(next[0], next[1], next[2])) {
          const std::size_t v = image.frame.offset(next[0], next[1], next[2]);
          if (seen[v] == 0 && image.voxels[v] != 0 && image.labels[image.voxels[v]] == label) {
            seen[v] = 1;
            queue.push(v);
          }
        }
      }
    }
  }
  return count;
}

TEST(VoxelContacts, CountsAgreeWithTheDefinition) {
  LabelImage image = empty_image({4, 4, 4});
  image.voxels[image.frame.offset(1, 1, 1)] = 1;
  image.voxels[image.frame.offset(2, 2, 2)] = 1;
  EXPECT_EQ(count_voxel_contacts(image).vertex_contacts, 1U);
  EXPECT_EQ(count_voxel_contacts(image).edge_contacts, 0U);
  EXPECT_EQ(contacts_by_definition(image), 1U);
  image.voxels[image.frame.offset(2, 2, 1)] = 1;
  EXPECT_EQ(count_voxel_contacts(image).vertex_contacts, 0U);
  EXPECT_EQ(count_voxel_contacts(image).edge_contacts, 1U);
  EXPECT_EQ(contacts_by_definition(image), 1U);
}

/// Cells are looked at a register at a time, the last one of a row over again: none may be missed or counted
/// twice, of voxels of one byte (material 1) or two (material 300).
TEST(VoxelContacts, AreFoundOnceAnywhereInARow) {
  for (const MaterialId material : {1, 300}) {
    for (const int length : {2, 9, 16, 17, 18, 33, 40}) {
      for (int i = 0; i + 1 < length; ++i) {
        LabelImage image = empty_image({length, 2, 2}, 300);
        image.voxels[image.frame.offset(i, 1, 0)] = material;
        image.voxels[image.frame.offset(i + 1, 0, 0)] = material;
        const ContactReport edge = count_voxel_contacts(image);
        EXPECT_EQ(edge.edge_contacts, 1U) << length << " " << i;
        EXPECT_EQ(edge.vertex_contacts, 0U) << length << " " << i;
        image.voxels[image.frame.offset(i + 1, 0, 0)] = kBackground;
        image.voxels[image.frame.offset(i + 1, 0, 1)] = material;
        const ContactReport vertex = count_voxel_contacts(image);
        EXPECT_EQ(vertex.edge_contacts, 0U) << length << " " << i;
        EXPECT_EQ(vertex.vertex_contacts, 1U) << length << " " << i;
      }
    }
  }
}

TEST(VoxelContacts, TellsWhatEveryMaterialGained) {
  LabelImage image = testing::noise_image(24, 0.5, 1);
  std::vector<std::size_t> voxels = image.voxels_per_material();
  const ContactReport report = remove_voxel_contacts(image, 1);
  for (std::size_t m = 0; m < voxels.size(); ++m) {
    voxels[m] += static_cast<std::size_t>(report.gained[m]);
  }
  EXPECT_EQ(voxels, image.voxels_per_material());
}

TEST(VoxelContacts, NoneIsLeftInSeededNoiseOfAnyDensity) {
  for (const double density : {0.1, 0.3, 0.6, 0.9, 1.0}) {
    for (const std::uint32_t seed : {1U, 2U}) {
      LabelImage image = testing::noise_image(24, density, seed);
      ASSERT_GT(contacts_by_definition(image), 100U);
      const ContactReport report = remove_voxel_contacts(image, seed);
      EXPECT_EQ(contacts_by_definition(image), 0U) << density;
      EXPECT_LT(report.rounds, 60) << density;
    }
  }
}

TEST(VoxelContacts, ACheckerboardEnds) {
  LabelImage image = testing::make_image({12, 12, 12}, {1, 1, 1}, 2, [](const Vec3& p) {
    return 1 + (static_cast<int>(p.x) + static_cast<int>(p.y) + static_cast<int>(p.z)) % 2;
  });
  remove_voxel_contacts(image, 1);
  EXPECT_EQ(contacts_by_definition(image), 0U);
}

TEST(VoxelContacts, ACleanImageIsLeftAlone) {
  const LabelImage before = testing::make_image({20, 20, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.x < 5 ? 0 : p.y < 9 ? 1 : 2;
  });
  LabelImage after = before;
  EXPECT_EQ(remove_voxel_contacts(after, 1).voxels_changed, 0U);
  EXPECT_EQ(after.voxels, before.voxels);
}

TEST(VoxelRegions, AreTheFaceConnectedComponents) {
  for (const std::uint32_t seed : {4U, 5U}) {
    LabelImage image = testing::noise_image(20, 0.4, seed);
    const std::size_t expected = components(image);
    const RegionReport report = split_regions(image);
    EXPECT_EQ(report.regions, expected);
    EXPECT_EQ(image.labels.size(), 1 + expected);
    EXPECT_EQ(components(image), expected);  // labels are kept, so the components are too
  }
}

TEST(VoxelRegions, SmallOnesGoAndTheLargestStays) {
  LabelImage image = testing::make_image({50, 20, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool large = p.x < 25;                                    // 10,000 voxels
    const bool crumb = p.x > 30 && p.x < 32 && p.y < 1 && p.z < 1;  // one voxel
    const bool lone = p.x > 40 && p.x < 42 && p.y < 1 && p.z < 1;   // one voxel, all there is of label 2
    return large || crumb ? 1 : lone ? 2 : 0;
  });
  const RegionReport report = remove_small_regions(image, 2e-4);
  EXPECT_EQ(report.regions_removed, 1U);
  EXPECT_EQ(report.voxels_removed, 1U);
  EXPECT_EQ(report.voxels_before, (std::vector<std::size_t>{9998, 10001, 1}));
  EXPECT_EQ(image.voxels_per_material(), (std::vector<std::size_t>{9999, 10000, 1}));
  EXPECT_EQ(remove_small_regions(image, 1e-5).regions_removed, 0U);
}

/// A comb whose teeth meet only in the last slice, many slices from where they begin, is one region; teeth
/// that do not reach it are regions of their own.
TEST(VoxelRegions, AreJoinedOverAnyNumberOfSlices) {
  LabelImage image = testing::make_image({20, 3, 100}, {1, 1, 1}, 1, [](const Vec3& p) {
    const auto x = std::lround(p.x);
    const bool joined = x < 10 && std::lround(p.z) == 99;
    return joined || (x % 2 == 0 && std::lround(p.z) < 98) || (x % 2 == 0 && x < 10) ? 1 : 0;
  });
  LabelImage split = image;
  EXPECT_EQ(split_regions(split).regions, 1U + 5U);
  EXPECT_EQ(split.voxels_per_material()[1], 5U * 3U * 99U + 10U * 3U);
  const RegionReport report = remove_small_regions(image, 0.2);
  EXPECT_EQ(report.regions_removed, 5U);
  EXPECT_EQ(report.voxels_removed, 5U * 3U * 98U);
}

TEST(VoxelNoise, BothTypesAreFoundAndSwitchable) {
  const auto noisy = [] {
    LabelImage image =
        testing::make_image({20, 9, 9}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 10 ? 1 : 0; });
    image.voxels[image.frame.offset(5, 4, 4)] = 0;   // hole
    image.voxels[image.frame.offset(15, 4, 4)] = 1;  // speck in background
    image.voxels[image.frame.offset(3, 2, 2)] = 2;   // speck in label 1
    return image;
  };
  for (const auto& [which, holes, specks] :
       {std::tuple{NoisyVoxels::none, 0U, 0U}, std::tuple{NoisyVoxels::holes, 1U, 0U},
        std::tuple{NoisyVoxels::specks, 0U, 2U}, std::tuple{NoisyVoxels::both, 1U, 2U}}) {
    LabelImage image = noisy();
    const NoiseReport report = relabel_noisy_voxels(image, which);
    EXPECT_EQ(report.holes_filled, holes);
    EXPECT_EQ(report.specks_relabelled, specks);
    EXPECT_EQ(image.at(5, 4, 4), holes == 1 ? 1 : 0);
    EXPECT_EQ(image.at(15, 4, 4), specks == 2 ? 0 : 1);
    EXPECT_EQ(image.at(3, 2, 2), specks == 2 ? 1 : 2);
  }
}

TEST(CleanImage, SameAtOneAndTwoThreads) {
  LabelImage one = testing::noise_image(40, 0.5, 9);
  LabelImage two = one;
  CleanOptions options;
  options.relabel_noise = NoisyVoxels::both;
  omp_set_num_threads(1);
  clean_image(one, options, true);
  omp_set_num_threads(2);
  clean_image(two, options, true);
  EXPECT_EQ(one.voxels, two.voxels);
  EXPECT_EQ(one.labels, two.labels);
}

TEST(CleanImage, RegionsOfTheCleanImageTouchByFacesOrNotAtAll) {
  LabelImage image = testing::noise_image(30, 0.25, 3);
  CleanOptions options;
  options.region_tolerance = 0;
  clean_image(image, options, true);
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {  // back to one material a label
    image.voxels.set(v, static_cast<MaterialId>(image.labels[image.voxels[v]]));
  }
  EXPECT_EQ(contacts_by_definition(image), 0U);
}

}  // namespace
}  // namespace cbc3d
