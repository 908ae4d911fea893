#include "metrics/topology_difference.hpp"

#include <gtest/gtest.h>

#include <random>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

using Kind = TopologyPlaceKind;

constexpr Index3 kSize{13, 12, 11};
constexpr Vec3 kSpacing{1, .5, 2};

LabelImage image_with(const std::vector<std::pair<Index3, Index3>>& boxes, MaterialId material = 1) {
  LabelImage image = test::empty_image(kSize, kSpacing, {0, 3, 8});
  for (const auto& [low, high] : boxes) test::fill_box(image, low, high, material);
  return image;
}

TopologyDifference difference_of(const Mesh& mesh, const LabelImage& image) {
  const MeshView view(mesh, image);
  const std::vector<Facet> facets = sorted_facets(view);
  const Surface surface = extract_surface(view, facets);
  return topology_difference(view, surface, topology(view, facets, surface), image_topology(image), image);
}

// The voxels of `meshed` as tets, judged against `image`.
TopologyDifference difference_of(const LabelImage& meshed, const LabelImage& image) {
  return difference_of(test::kuhn_mesh(meshed), image);
}

void expect_one_place(const TopologyDifference& found, Kind kind, const LabelImage& image,
                      const Index3& voxel) {
  ASSERT_EQ(found.places.size(), 1U);
  EXPECT_EQ(found.places[0].kind, kind);
  EXPECT_EQ(found.places[0].label, 3);
  const Vec3 centre = image.frame.to_physical(image.frame.local_centre(voxel[0], voxel[1], voxel[2]));
  EXPECT_LT((found.places[0].at_mm - centre).norm(), 1.001)
      << found.places[0].at_mm.x << " " << found.places[0].at_mm.y << " " << found.places[0].at_mm.z;
}

const LabelImage kBlock = image_with({{{2, 2, 2}, {8, 8, 8}}});
const LabelImage kPlate = image_with({{{2, 2, 5}, {8, 8, 5}}});

LabelImage without(LabelImage image, const Index3& voxel) {
  image.voxels[image.frame.offset(voxel[0], voxel[1], voxel[2])] = 0;
  return image;
}
LabelImage with(LabelImage image, const Index3& voxel) {
  image.voxels[image.frame.offset(voxel[0], voxel[1], voxel[2])] = 1;
  return image;
}

TEST(TopologyDifference, NoneOfTheVoxelsThemselves) {
  for (const LabelImage& image : {kBlock, kPlate, without(kBlock, {5, 5, 5}), without(kPlate, {5, 5, 5})}) {
    const TopologyDifference found = difference_of(image, image);
    EXPECT_EQ(found.total, std::optional<std::int64_t>(0));
    EXPECT_TRUE(found.places.empty());
    EXPECT_FALSE(found.per_label[0].open);
  }
}

TEST(TopologyDifference, PlantedTunnel) {
  const TopologyDifference found = difference_of(without(kPlate, {4, 6, 5}), kPlate);
  EXPECT_EQ(found.total, std::optional<std::int64_t>(1));
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{0, 1, 0}));
  expect_one_place(found, Kind::kTunnelAdded, kPlate, {4, 6, 5});
}

TEST(TopologyDifference, FilledTunnel) {
  const LabelImage ring = without(kPlate, {4, 6, 5});
  const TopologyDifference found = difference_of(kPlate, ring);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{0, -1, 0}));
  expect_one_place(found, Kind::kTunnelLost, kPlate, {4, 6, 5});
}

TEST(TopologyDifference, ManyTunnelsEachHasAPlace) {
  LabelImage meshed = kPlate;
  for (const int i : {3, 5, 7}) {
    for (const int j : {3, 5, 7}) meshed = without(meshed, {i, j, 5});
  }
  const TopologyDifference found = difference_of(meshed, kPlate);
  EXPECT_EQ(found.total, std::optional<std::int64_t>(9));
  EXPECT_EQ(found.places.size(), 9U);
}

TEST(TopologyDifference, PlantedAndLostPart) {
  const LabelImage both = with(kBlock, {11, 10, 9});
  expect_one_place(difference_of(both, kBlock), Kind::kPartAdded, kBlock, {11, 10, 9});
  const TopologyDifference found = difference_of(kBlock, both);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{-1, 0, 0}));
  expect_one_place(found, Kind::kPartLost, kBlock, {11, 10, 9});
}

TEST(TopologyDifference, SplitAndJoinedParts) {
  const LabelImage bar = image_with({{{2, 5, 5}, {10, 5, 5}}});
  const LabelImage broken = without(bar, {8, 5, 5});
  const TopologyDifference split = difference_of(broken, bar);
  EXPECT_EQ(split.total, std::optional<std::int64_t>(1));
  expect_one_place(split, Kind::kPartSplit, bar, {9, 5, 5});
  expect_one_place(difference_of(bar, broken), Kind::kPartsJoined, bar, {9, 5, 5});
}

TEST(TopologyDifference, PlantedAndLostCavity) {
  const LabelImage hollow = without(kBlock, {4, 5, 6});
  const TopologyDifference added = difference_of(hollow, kBlock);
  EXPECT_EQ(added.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{0, 0, 1}));
  expect_one_place(added, Kind::kCavityAdded, kBlock, {4, 5, 6});
  expect_one_place(difference_of(kBlock, hollow), Kind::kCavityLost, kBlock, {4, 5, 6});
}

TEST(TopologyDifference, AnotherLabelInsideIsACavityToo) {
  LabelImage image = kBlock;
  test::fill_box(image, {4, 4, 4}, {5, 5, 5}, 2);
  EXPECT_EQ(difference_of(image, image).total, std::optional<std::int64_t>(0));
  const TopologyDifference found = difference_of(kBlock, image);
  EXPECT_EQ(found.total, std::optional<std::int64_t>(2));  // the cavity of 3, the part of 8
  ASSERT_EQ(found.places.size(), 2U);
  EXPECT_EQ(found.places[0].kind, Kind::kCavityLost);
  EXPECT_EQ(found.places[1].kind, Kind::kPartLost);
  EXPECT_EQ(found.places[1].label, 8);
}

TEST(TopologyDifference, ContactAtACornerMakesTheLabelOpen) {
  // The mesh of the voxels hangs together at the corner, the open set does not.
  const LabelImage image = image_with({{{2, 2, 2}, {4, 4, 4}}, {{5, 5, 5}, {6, 6, 6}}});
  const TopologyDifference found = difference_of(image, image);
  EXPECT_TRUE(found.per_label[0].open);
  EXPECT_EQ(found.per_label[0].difference().value().b, (std::array<std::int64_t, 3>{-1, 0, 0}));
  ASSERT_EQ(found.places.size(), 1U);
  EXPECT_EQ(found.places[0].kind, Kind::kPartsJoined);
  // Which of the two holds does not depend on the mesh: this one keeps them apart.
  Mesh apart = test::kuhn_mesh(image_with({{{2, 2, 2}, {4, 4, 4}}}));
  const Mesh other = test::kuhn_mesh(image_with({{{5, 5, 5}, {6, 6, 6}}}));
  const auto first = static_cast<VertexId>(apart.points.size());
  apart.points.insert(apart.points.end(), other.points.begin(), other.points.end());
  for (auto tet : other.tets.nodes) {
    for (VertexId& v : tet) v += first;
    apart.tets.add(tet, 3);
  }
  EXPECT_EQ(difference_of(apart, image).total, std::optional<std::int64_t>(0));
}

TEST(TopologyDifference, JsonHasTheKeys) {
  LabelImage image = kPlate;
  test::fill_box(image, {2, 2, 8}, {3, 3, 9}, 2);
  const auto topology =
      test::judge(test::kuhn_mesh(without(kPlate, {4, 6, 5})), image, {false, false})["topology"];
  EXPECT_EQ(topology["differences"], 2);
  EXPECT_EQ(topology["per_label"][0]["differences"], 1);
  EXPECT_EQ(topology["per_label"][0]["image_topology"], "closed");
  EXPECT_EQ(topology["per_label"][0]["betti_difference"], (nlohmann::json{0, 1, 0}));
  EXPECT_EQ(topology["missing_labels_topology"][0]["label"], 8);
  EXPECT_EQ(topology["missing_labels_topology"][0]["differences"], 1);
  EXPECT_EQ(topology["difference_places"]["per_kind"]["tunnel_added"], 1);
  EXPECT_EQ(topology["difference_places"]["per_kind"]["part_lost"], 1);
  EXPECT_EQ(topology["difference_places"]["list"][0]["kind"], "tunnel_added");
}

TEST(TopologyDifference, LabelThatTheImageHasNotIsAllDifference) {
  LabelImage meshed = kBlock;
  meshed.labels = {0, 5, 8};
  const TopologyDifference found = difference_of(test::kuhn_mesh(meshed), kBlock);
  EXPECT_EQ(found.total, std::optional<std::int64_t>(2));  // 3 is lost, 5 is added
}

TEST(TopologyDifference, NothingWhereTheCellsAreNoSet) {
  Mesh mesh = test::kuhn_mesh(kBlock);
  mesh.tets.add(mesh.tets.nodes[0], 3);  // its facets have more than two cells
  const TopologyDifference found = difference_of(mesh, kBlock);
  EXPECT_FALSE(found.total);
}

TEST(TopologyDifference, RandomImagesEachTunnelOfOneVoxelIsFound) {
  // Voxels drilled through a plate at random: the tunnels that the image loses are those that the walk
  // places, as long as nothing else changes.
  std::mt19937 random(9);
  for (int trial = 0; trial < 10; ++trial) {
    LabelImage meshed = kPlate;
    for (int n = 0; n < 5; ++n) {
      meshed = without(meshed, {3 + static_cast<int>(random() % 5), 3 + static_cast<int>(random() % 5), 5});
    }
    const TopologyDifference found = difference_of(meshed, kPlate);
    const Betti difference = found.per_label[0].difference().value();
    EXPECT_EQ(difference.b[0], 0);
    EXPECT_EQ(static_cast<std::int64_t>(found.places.size()), difference.b[1]);
  }
}

}  // namespace
}  // namespace cbc3d::metrics
