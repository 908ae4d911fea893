#include "metrics/fidelity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/box_tree.hpp"
#include "metrics/dice.hpp"
#include "metrics/image_boundary.hpp"
#include "metrics/point_set_hausdorff.hpp"
#include "metrics/surface.hpp"
#include "metrics/surface_hausdorff.hpp"
#include "metrics/testing.hpp"
#include "metrics/volumes.hpp"

namespace cbc3d::metrics {
namespace {

std::vector<Vec3> random_points(std::size_t count, unsigned seed, double size) {
  std::mt19937 random(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) p[axis] = size * static_cast<double>(random()) / 4294967296.0;
  return points;
}

double brute_directed(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double largest = 0;
  for (const Vec3& p : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& q : to) nearest = std::min(nearest, (p - q).norm());
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(PointSetDistance, AgreesWithBruteForce) {
  const auto a = random_points(700, 1, 10), b = random_points(300, 2, 11);
  const auto found = point_set_distance(a, b);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found.value().image_to_mesh_mm, brute_directed(a, b), 1e-12);
  EXPECT_NEAR(found.value().mesh_to_image_mm, brute_directed(b, a), 1e-12);
  EXPECT_NE(found.value().image_to_mesh_mm, found.value().mesh_to_image_mm);
  EXPECT_FALSE(point_set_distance({}, b));
  EXPECT_FALSE(point_set_distance(a, {}));
}

// Nearest point of a triangle by a dense barycentric grid.
double sampled_distance(const Triangle& t, const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 200;
  for (int u = 0; u <= kSteps; ++u) {
    for (int v = 0; u + v <= kSteps; ++v) {
      const double s = u / double{kSteps}, r = v / double{kSteps};
      nearest = std::min(nearest, (t.a + s * (t.b - t.a) + r * (t.c - t.a) - p).norm());
    }
  }
  return nearest;
}

TEST(BoxTree, TriangleDistance) {
  const auto points = random_points(4 * 60, 3, 1);
  for (std::size_t n = 0; n + 3 < points.size(); n += 4) {
    const Triangle t{points[n], points[n + 1], points[n + 2]};
    const double exact = std::sqrt(t.squared_distance(points[n + 3]));
    const double sampled = sampled_distance(t, points[n + 3]);
    EXPECT_LE(exact, sampled + 1e-12);
    EXPECT_NEAR(exact, sampled, 0.01);
  }
  const Triangle needle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_NEAR(needle.squared_distance({1.5, 2, 0}), 4, 1e-15);
}

TEST(BoxTree, NearestIsTheNearest) {
  const auto points = random_points(3 * 501, 4, 10);
  std::vector<Triangle> triangles;
  for (std::size_t n = 0; n < points.size(); n += 3)
    triangles.push_back({points[n], points[n] + .1 * points[n + 1], points[n] + .1 * points[n + 2]});
  const BoxTree<Triangle> tree(triangles);
  std::size_t hint = 0;
  for (const Vec3& p : random_points(200, 5, 12)) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Triangle& t : triangles) nearest = std::min(nearest, t.squared_distance(p));
    EXPECT_EQ(tree.nearest(p).squared, nearest);
    const auto hinted = tree.nearest(p, hint);
    EXPECT_EQ(hinted.squared, nearest);
    hint = hinted.index;
  }
}

bool brute_inside(const std::array<VertexId, 4>& tet, const std::vector<Vec3>& points, const Vec3& p) {
  const Vec3 &a = points[tet[0]], &b = points[tet[1]], &c = points[tet[2]], &d = points[tet[3]];
  const double sign = six_volumes(a, b, c, d) < 0 ? -1 : 1;
  return sign * six_volumes(p, b, c, d) > 0 && sign * six_volumes(a, p, c, d) > 0 &&
         sign * six_volumes(a, b, p, d) > 0 && sign * six_volumes(a, b, c, p) > 0;
}

TEST(Rasterise, AgreesWithBruteForceOnRandomTets) {
  LabelImage image = test::empty_image({20, 18, 16}, {.6, .7, .9}, {0, 3, 4, 9});
  Mesh mesh;
  mesh.points = random_points(80, 6, 14);
  for (VertexId v = 0; v < 80; v += 4)
    mesh.tets.add({v, v + 1, v + 2, v + 3}, std::array<Label, 4>{3, 4, 9, 5}[v / 4 % 4]);  // 5 is unknown
  const MeshView view(mesh, image);
  const auto found = rasterise(view, image);
  std::size_t covered = 0;
  for (std::size_t v = 0; v < found.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    MaterialId expected = kUncovered;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (brute_inside(mesh.tets.nodes[t], mesh.points, image.frame.local_centre(at[0], at[1], at[2]))) {
        for (MaterialId m = 1; m < 4; ++m)
          if (image.labels[m] == mesh.tets.labels[t]) expected = std::min(expected, m);
      }
    }
    ASSERT_EQ(found[v], expected) << v;
    covered += expected != kUncovered ? 1 : 0;
  }
  EXPECT_GT(covered, 500U);
}

TEST(Rasterise, CentresOnFacetsCountOnce) {
  // A mesh through the voxel centres: every centre lies on a vertex, an edge or a facet. Half-open by the
  // nudge, the 4 x 4 x 4 block of cells holds exactly 4 x 4 x 4 centres, each in one tet.
  LabelImage image = test::empty_image({8, 8, 8}, {1, 1, 1}, {0, 1});
  LabelImage block = test::empty_image({8, 8, 8}, {1, 1, 1}, {0, 1});
  test::fill_box(block, {2, 2, 2}, {5, 5, 5}, 1);
  Mesh mesh = test::kuhn_mesh(block);
  for (Vec3& p : mesh.points) p += Vec3{.5, .5, .5};
  const auto found = rasterise(MeshView(mesh, image), image);
  EXPECT_EQ(std::count(found.begin(), found.end(), MaterialId{1}), 64);
}

TEST(Volumes, SplitCellsAddUp) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5},
                 {2, 3, 5}, {0, 3, 5}, {1, 1, 7}, {4, 0, 0}, {4, 0, 5}};
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  mesh.pyramids.add({4, 5, 6, 7, 8}, 2);
  mesh.wedges.add({1, 9, 2, 5, 10, 6}, 3);
  const MeshView view(mesh, test::two_boxes());
  const auto volumes = label_volumes_mm3(view);
  EXPECT_NEAR(volumes[0], 30, 1e-12);
  EXPECT_NEAR(volumes[1], 4, 1e-12);
  EXPECT_NEAR(volumes[2], 15, 1e-12);
}

TEST(Volumes, SplitDoesNotDependOnNumbering) {
  // Whichever corner has the lowest number, a box is six or five positive tets of the whole volume.
  std::array<VertexId, 8> order{0, 1, 2, 3, 4, 5, 6, 7};
  for (int round = 0; round < 40; ++round) {
    std::mt19937 random(static_cast<unsigned>(round));
    for (std::size_t n = 7; n > 0; --n) std::swap(order[n], order[random() % (n + 1)]);
    const std::array<Vec3, 8> cube{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0},
                                   Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{1, 1, 1}, Vec3{0, 1, 1}};
    std::array<Vec3, 8> points;
    for (std::size_t n = 0; n < 8; ++n) points[order[n]] = cube[n];
    const TetSplit split = split_into_tets({CellKind::kHex, order});
    double volume = 0;
    for (int t = 0; t < split.count; ++t) {
      const auto& tet = split.tets[static_cast<std::size_t>(t)];
      const double six = six_volumes(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]);
      EXPECT_GT(six, 0);
      volume += six / 6;
    }
    EXPECT_NEAR(volume, 1, 1e-14);
  }
}

TEST(ImageBoundary, VoxelsAndFacesOfABox) {
  LabelImage image = test::empty_image({6, 6, 6}, {1, 2, 3}, {0, 1});
  test::fill_box(image, {0, 1, 1}, {3, 4, 4}, 1);  // touches the image's border, which is exposed too
  const auto boundaries = image_boundaries(image);
  EXPECT_TRUE(boundaries[0].faces.empty());
  EXPECT_EQ(boundaries[1].voxel_centres.size(), 64U - 8U);
  EXPECT_EQ(boundaries[1].faces.size(), 6U * 16U);
  EXPECT_EQ(centre_of({{0, 1, 1}, 0, -1}, image.frame), (Vec3{-.5, 2, 3}));
}

TEST(SurfaceDistance, SamplesOfAShiftedBox) {
  LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  for (Vec3& p : mesh.points) p.x += 0.25;
  const auto fidelity = test::judge(mesh, image)["fidelity"];
  EXPECT_NEAR(fidelity["surface_hausdorff_mm"].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(fidelity["hd95_mm"].get<double>(), 0.25, 1e-12);
  EXPECT_GT(fidelity["mean_distance_mm"].get<double>(), 0.05);
  EXPECT_LT(fidelity["mean_distance_mm"].get<double>(), 0.25);
}

TEST(PointSetDistance, PunishesLargeFacetsOfAnExactMesh) {
  // A box of 20 voxels a side as six tets: the centre of a side's middle voxel is 9.5, 9.5 and .5 from a
  // corner.
  LabelImage image = test::empty_image({40, 40, 40}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {10, 10, 10}, {29, 29, 29}, 1);
  LabelImage coarse = test::empty_image({3, 3, 3}, {20, 20, 20}, {0, 1});
  test::fill_box(coarse, {1, 1, 1}, {1, 1, 1}, 1);
  Mesh mesh = test::kuhn_mesh(coarse);
  for (Vec3& p : mesh.points) p -= Vec3{.5, .5, .5};
  const auto fidelity = test::judge(mesh, image)["fidelity"];
  EXPECT_NEAR(fidelity["hausdorff_mm"].get<double>(), std::sqrt(2 * 9.5 * 9.5 + .25), 1e-9);
  EXPECT_NEAR(fidelity["surface_hausdorff_bounds_mm"][1].get<double>(), 0, .02 + 1e-12);
  EXPECT_NEAR(fidelity["volume_error_percent_max"].get<double>(), 0, 1e-9);
  EXPECT_EQ(fidelity["dice_min"], 1.0);
}

}  // namespace
}  // namespace cbc3d::metrics
