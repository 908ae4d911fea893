// Differences in topology between an image and what a mesh makes of its voxels: planted ones are found, and
// moved boundaries are none.
#include "mesher/lattice/voxel_topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// The parts whose material in the mesh, by the centre of the part in local mm, is not the image's.
std::vector<MisplacedPart> misplaced_parts(const LabelImage& image,
                                           const std::function<MaterialId(const Vec3&)>& in_mesh) {
  const ImageFrame frame = part_frame(image.frame);
  std::vector<MisplacedPart> misplaced;
  for (std::size_t offset = 0; offset < frame.voxel_count(); ++offset) {
    const Index3 at = frame.index_of(offset);
    const Vec3 centre = image.frame.to_local(frame.to_physical(frame.local_centre(at[0], at[1], at[2])));
    const MaterialId material = in_mesh(centre);
    if (material != image.at_local(centre)) {
      misplaced.push_back({offset, material});
    }
  }
  return misplaced;
}

LabelImage slab(const Vec3& spacing_mm) {
  return testing::make_image({12, 12, 8}, spacing_mm, 1, [&](const Vec3& p) {
    return p.z / spacing_mm.z > 2.5 && p.z / spacing_mm.z < 5.5 ? 1 : 0;
  });
}

TEST(VoxelTopology, PartsAreAboutCubesInTheVoxelsPlaces) {
  ImageFrame frame;
  frame.size = {3, 4, 5};
  frame.spacing_mm = {0.5, 0.5, 1.3};
  frame.origin_mm = {7, 8, 9};
  EXPECT_EQ(voxel_parts(frame), (Index3{2, 2, 5}));
  const ImageFrame parts = part_frame(frame);
  EXPECT_EQ(parts.size, (Index3{6, 8, 25}));
  EXPECT_NEAR(parts.spacing_mm.z, 0.26, 1e-12);
  // The five parts of the first voxel have its centre in the middle.
  EXPECT_NEAR(parts.to_physical(parts.local_centre(0, 0, 2)).z, 9, 1e-12);
  EXPECT_NEAR(parts.to_physical(parts.local_centre(0, 0, 0)).x, 7 - 0.125, 1e-12);
  frame.spacing_mm = {0.1, 1, 100};
  EXPECT_EQ(voxel_parts(frame), (Index3{2, 8, 8})) << "needles and plates have a bound";
}

TEST(VoxelTopology, AMovedBoundaryIsNoDifference) {
  const LabelImage image = slab({1, 1, 1.3});
  EXPECT_TRUE(find_topology_differences(image, {}, {1}).empty());
  for (const double shift_mm : {-1.4, -0.6, 0.7, 1.5}) {
    const auto misplaced = misplaced_parts(image, [&](const Vec3& x) {
      return image.at_local({x.x, x.y, x.z + shift_mm * std::sin(x.x / 3)});
    });
    ASSERT_FALSE(misplaced.empty());
    EXPECT_TRUE(find_topology_differences(image, misplaced, {1}).empty()) << shift_mm;
  }
}

TEST(VoxelTopology, PlantedTunnelsCavitiesAndPartsAreFoundWhereTheyAre) {
  const LabelImage image = slab({1, 1, 1});
  const auto place_of = [&](const std::function<MaterialId(const Vec3&)>& in_mesh) {
    std::vector<Index3> places;
    for (const std::size_t offset : find_topology_differences(image, misplaced_parts(image, in_mesh), {1})) {
      places.push_back(image.frame.index_of(offset));
    }
    return places;
  };
  const auto tunnel = place_of([&](const Vec3& x) {
    const bool in_it = std::abs(x.x - 6) < 0.5 && std::abs(x.y - 4) < 0.5;
    return in_it ? MaterialId{0} : image.at_local(x);
  });
  ASSERT_FALSE(tunnel.empty());
  for (const Index3& at : tunnel) {
    EXPECT_EQ(at[0], 6);
    EXPECT_EQ(at[1], 4);
  }
  const auto cavity = place_of([&](const Vec3& x) {
    const bool in_it = std::abs(x.x - 6) < 0.5 && std::abs(x.y - 4) < 0.5 && std::abs(x.z - 4) < 0.5;
    return in_it ? MaterialId{0} : image.at_local(x);
  });
  EXPECT_EQ(cavity, (std::vector<Index3>{{6, 4, 4}}));
  const auto piece = place_of([&](const Vec3& x) {
    const bool in_it = std::abs(x.x - 9) < 0.5 && std::abs(x.y - 2) < 0.5 && std::abs(x.z - 1) < 0.3;
    return in_it ? MaterialId{1} : image.at_local(x);
  });
  EXPECT_EQ(piece, (std::vector<Index3>{{9, 2, 1}}));
}

TEST(VoxelTopology, OtherLabelsMayChange) {
  const LabelImage image = slab({1, 1, 1});
  const auto misplaced = misplaced_parts(image, [](const Vec3&) { return MaterialId{0}; });
  EXPECT_FALSE(find_topology_differences(image, misplaced, {1}).empty());
  EXPECT_TRUE(find_topology_differences(image, misplaced, {2}).empty());
}

/// Regions of one label are one label: what changes between them alone has no topology.
TEST(VoxelTopology, MaterialsOfOneLabelAreNotToldApart) {
  LabelImage image =
      testing::make_image({8, 4, 4}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 3.5 ? 1 : 2; });
  image.labels = {0, 5, 5};
  const auto misplaced = misplaced_parts(
      image, [](const Vec3& x) { return static_cast<MaterialId>(std::fmod(x.x, 2) < 1 ? 1 : 2); });
  ASSERT_FALSE(misplaced.empty());
  EXPECT_TRUE(find_topology_differences(image, misplaced, {5}).empty());
}

TEST(VoxelTopology, VoxelsOfPartsAscendAndStandOnce) {
  ImageFrame frame;
  frame.size = {3, 3, 3};
  const ImageFrame parts = part_frame(frame);
  const std::vector<MisplacedPart> misplaced = {
      {parts.offset(0, 0, 0), 1}, {parts.offset(1, 1, 0), 1}, {parts.offset(5, 4, 3), 1}};
  EXPECT_EQ(voxels_of_parts(frame, misplaced),
            (std::vector<std::size_t>{frame.offset(0, 0, 0), frame.offset(2, 2, 1)}));
}

}  // namespace
}  // namespace cbc3d
