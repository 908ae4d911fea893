// What is one voxel thick: a closed box, a strand and a plate, their meshes with holes and cuts at known
// places, which the difference of the topologies must count and name.
#include <gtest/gtest.h>

#include <algorithm>

#include "metrics/testing.hpp"
#include "metrics/topology_difference.hpp"

namespace cbc3d::metrics {
namespace {

using Kind = TopologyPlaceKind;

constexpr Vec3 kSpacing{1, .8, 1.2};

LabelImage thin_box() {
  LabelImage image = test::empty_image({24, 24, 24}, kSpacing, {0, 7});
  test::fill_box(image, {4, 4, 4}, {19, 19, 19}, 1);
  test::fill_box(image, {5, 5, 5}, {18, 18, 18}, 0);
  return image;
}

LabelImage strand() {
  LabelImage image = test::empty_image({20, 20, 20}, kSpacing, {0, 7});
  test::fill_box(image, {2, 4, 4}, {16, 4, 4}, 1);
  test::fill_box(image, {16, 4, 4}, {16, 15, 4}, 1);
  test::fill_box(image, {16, 15, 4}, {16, 15, 17}, 1);
  return image;
}

LabelImage plate() {
  LabelImage image = test::empty_image({40, 40, 5}, kSpacing, {0, 7});
  test::fill_box(image, {2, 2, 2}, {37, 37, 2}, 1);
  return image;
}

LabelImage without(LabelImage image, const std::vector<Index3>& voxels) {
  for (const Index3& at : voxels) {
    image.voxels[image.frame.offset(at[0], at[1], at[2])] = 0;
  }
  return image;
}

TopologyDifference difference_of(const LabelImage& meshed, const LabelImage& image) {
  const Mesh mesh = test::kuhn_mesh(meshed);
  const MeshView view(mesh, image);
  const std::vector<Facet> facets = sorted_facets(view);
  const Surface surface = extract_surface(view, facets);
  return topology_difference(view, surface, topology(view, facets, surface), image_topology(image), image);
}

Vec3 centre(const LabelImage& image, const Index3& voxel) {
  return image.frame.to_physical(image.frame.local_centre(voxel[0], voxel[1], voxel[2]));
}

std::vector<Vec3> places_of(const TopologyDifference& found, Kind kind) {
  std::vector<Vec3> places;
  for (const TopologyPlace& place : found.places) {
    EXPECT_EQ(place.label, 7);
    if (place.kind == kind) places.push_back(place.at_mm);
  }
  return places;
}

/// Every place is within a voxel of one of the voxels, no two of the same.
void expect_each_at_one(const std::vector<Vec3>& places, const LabelImage& image,
                        const std::vector<Index3>& voxels) {
  constexpr double kReachMm = 1.21;
  std::vector<int> found(voxels.size());
  for (const Vec3& place : places) {
    const auto at = std::find_if(voxels.begin(), voxels.end(), [&](const Index3& voxel) {
      return (place - centre(image, voxel)).norm() <= kReachMm;
    });
    ASSERT_NE(at, voxels.end()) << place.x << " " << place.y << " " << place.z;
    EXPECT_EQ(++found[static_cast<std::size_t>(at - voxels.begin())], 1);
  }
}

TEST(ThinImages, TheirVoxelsAsTetsHaveNoDifference) {
  for (const LabelImage& image : {thin_box(), strand(), plate()}) {
    const TopologyDifference found = difference_of(image, image);
    EXPECT_EQ(found.total, std::optional<std::int64_t>(0));
    EXPECT_TRUE(found.places.empty());
  }
}

TEST(ThinImages, HolesInTheWallsOfABox) {
  // The first hole opens the cavity, each other one makes a tunnel.
  const std::vector<Index3> holes{{4, 8, 8},  {4, 14, 15}, {19, 8, 14}, {19, 15, 9},
                                  {8, 4, 8},  {14, 4, 15}, {8, 19, 9},  {15, 19, 8},
                                  {8, 14, 4}, {14, 9, 4},  {9, 9, 19},  {14, 14, 19}};
  const LabelImage image = thin_box();
  const TopologyDifference found = difference_of(without(image, holes), image);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{0, 11, -1}));
  EXPECT_EQ(found.total, std::optional<std::int64_t>(12));
  const std::vector<Vec3> tunnels = places_of(found, Kind::kTunnelAdded);
  EXPECT_EQ(tunnels.size(), 11U);
  expect_each_at_one(tunnels, image, holes);
  const std::vector<Vec3> cavities = places_of(found, Kind::kCavityLost);
  ASSERT_EQ(cavities.size(), 1U);
  for (int axis = 0; axis < 3; ++axis) {  // inside the box
    EXPECT_GT(cavities[0][axis], centre(image, {4, 4, 4})[axis]);
    EXPECT_LT(cavities[0][axis], centre(image, {19, 19, 19})[axis]);
  }
}

TEST(ThinImages, CutsThroughAStrand) {
  const std::vector<Index3> cuts{{9, 4, 4}, {16, 9, 4}, {16, 15, 10}};
  const LabelImage image = strand();
  const TopologyDifference found = difference_of(without(image, cuts), image);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{3, 0, 0}));
  // One of the four parts stays, the others are split off: each has a place within it.
  EXPECT_EQ(places_of(found, Kind::kPartSplit).size(), 3U);
  EXPECT_EQ(found.places.size(), 3U);
}

TEST(ThinImages, HolesInAPlate) {
  std::vector<Index3> holes;
  for (int i = 4; i < 36; i += 3) {
    for (int j = 4; j < 36; j += 3) holes.push_back({i, j, 2});
  }
  const LabelImage image = plate();
  const TopologyDifference found = difference_of(without(image, holes), image);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{0, 121, 0}));
  const std::vector<Vec3> tunnels = places_of(found, Kind::kTunnelAdded);
  EXPECT_EQ(tunnels.size(), holes.size());
  expect_each_at_one(tunnels, image, holes);
}

}  // namespace
}  // namespace cbc3d::metrics
