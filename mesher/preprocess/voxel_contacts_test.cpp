// Contacts of voxels by an edge or a vertex, against their definition on seeded noise.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "mesher/preprocess/testing_contacts.hpp"
#include "mesher/preprocess/voxel_contacts.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::contacts_by_definition;

LabelImage empty_image(const Index3& size, int materials = 2) {
  return testing::make_image(size, {1, 1, 1}, materials, [](const Vec3&) { return 0; });
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

}  // namespace
}  // namespace cbc3d
