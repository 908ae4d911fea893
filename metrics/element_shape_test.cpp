#include "metrics/element_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "metrics/element_shapes.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

const std::array<Vec3, 4> kRegular{Vec3{1, 1, 1}, Vec3{-1, -1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}};
const std::array<Vec3, 4> kCorner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

std::array<Vec3, 8> box(double height) {
  return {Vec3{0, 0, 0},      Vec3{1, 0, 0},      Vec3{1, 1, 0},      Vec3{0, 1, 0},
          Vec3{0, 0, height}, Vec3{1, 0, height}, Vec3{1, 1, height}, Vec3{0, 1, height}};
}
std::array<Vec3, 5> pyramid(double height) {
  return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}, Vec3{.5, .5, height}};
}
std::array<Vec3, 6> prism(double height) {
  const double h = std::sqrt(3.0) / 2;
  return {Vec3{0, 0, 0},      Vec3{1, 0, 0},      Vec3{.5, h, 0},
          Vec3{0, 0, height}, Vec3{1, 0, height}, Vec3{.5, h, height}};
}

template <std::size_t N>
std::vector<VertexId> add_points(Mesh& mesh, const std::array<Vec3, N>& p, double x) {
  std::vector<VertexId> ids;
  for (const Vec3& point : p) {
    ids.push_back(static_cast<VertexId>(mesh.points.size()));
    mesh.points.push_back(point + Vec3{x, 0, 0});
  }
  return ids;
}

void add_tet(Mesh& mesh, const std::array<Vec3, 4>& p, double x, Label label) {
  const auto v = add_points(mesh, p, x);
  mesh.tets.add({v[0], v[1], v[2], v[3]}, label);
}

MeshShape shape_of(const Mesh& mesh) {
  const LabelImage image = test::two_boxes();
  return element_shape(MeshView(mesh, image));
}

TEST(ElementShape, RegularAndCornerTet) {
  EXPECT_NEAR(inverse_radius_ratio_tet(kRegular), 1, 1e-14);
  EXPECT_NEAR(height_ratio_tet(kRegular), 1, 1e-14);
  // Circumradius sqrt(3)/2, inradius 1/(3 + sqrt(3)); smallest height 1/sqrt(3), longest edge sqrt(2).
  EXPECT_NEAR(inverse_radius_ratio_tet(kCorner), 3 / ((3 + std::sqrt(3.0)) * std::sqrt(3.0) / 2), 1e-14);
  EXPECT_NEAR(height_ratio_tet(kCorner), .5, 1e-14);
  const std::array<VertexId, 4> nodes{0, 1, 2, 3};
  EXPECT_NEAR(edge_ratio({CellKind::kTet, nodes}, {kCorner.begin(), kCorner.end()}), std::sqrt(2.0), 1e-14);
}

TEST(ElementShape, SlabTet) {
  for (const double height : {.1, .01, .001}) {
    // Four corners of a square, two of them lifted.
    const std::array<Vec3, 4> slab{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, height}, Vec3{1, 0, height}};
    // V = height/3, its largest faces have the area sqrt(1 + 2 height^2) / 2, the longest edge is sqrt(2).
    EXPECT_NEAR(height_ratio_tet(slab), std::sqrt(3.0) * height / std::sqrt(1 + 2 * height * height), 1e-12);
    // Squared edges 2 * 2 + 4 (1 + height^2).
    EXPECT_NEAR(std::fabs(mean_ratio_tet(slab)), 12 * std::pow(height, 2.0 / 3) / (8 + 4 * height * height),
                1e-12);
  }
  const std::array<Vec3, 4> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(inverse_radius_ratio_tet(flat), 0);
  EXPECT_EQ(height_ratio_tet(flat), 0);
  EXPECT_EQ(height_ratio_tet({Vec3{}, Vec3{}, Vec3{}, Vec3{}}), 0);
}

TEST(ElementShape, Hex) {
  EXPECT_NEAR(mean_ratio_hex(box(1)), 1, 1e-14);
  EXPECT_NEAR(mean_ratio_hex(box(2)), 3 * std::pow(2, 2.0 / 3) / 6, 1e-14);
  auto sheared = box(1);
  for (Vec3& p : sheared) p.x += .5 * p.z;  // determinant 1, squared lengths 1, 1, 1.25
  EXPECT_NEAR(mean_ratio_hex(sheared), 3 / 3.25, 1e-14);
  auto inverted = box(1);
  for (Vec3& p : inverted) p.z = -p.z;
  EXPECT_NEAR(mean_ratio_hex(inverted), -1, 1e-14);
}

TEST(ElementShape, Wedge) {
  EXPECT_NEAR(mean_ratio_wedge(prism(1)), 1, 1e-14);
  for (const double h : {.25, 2.0}) {
    EXPECT_NEAR(mean_ratio_wedge(prism(h)), 3 * std::pow(h, 2.0 / 3) / (2 + h * h), 1e-14);
  }
  EXPECT_NEAR(mean_ratio_wedge(prism(-1)), -1, 1e-14);
}

TEST(ElementShape, Pyramid) {
  EXPECT_NEAR(mean_ratio_pyramid(pyramid(std::sqrt(.5))), 1, 1e-14);
  for (const double h : {.25, .5, 2.0}) {
    EXPECT_NEAR(mean_ratio_pyramid(pyramid(h)), 3 * std::pow(std::sqrt(2.0) * h, 2.0 / 3) / (2 + 2 * h * h),
                1e-14);
  }
  EXPECT_NEAR(mean_ratio_pyramid(pyramid(-std::sqrt(.5))), -1, 1e-14);
}

TEST(ElementShape, IsTheSameAtAnyPoseAndSize) {
  const auto turned = [](const Vec3& p) { return 7.5 * Vec3{.6 * p.x - .8 * p.y, .8 * p.x + .6 * p.y, p.z}; };
  auto hex = box(2);
  auto wedge = prism(2);
  auto pyr = pyramid(2);
  for (Vec3& p : hex) p = turned(p);
  for (Vec3& p : wedge) p = turned(p);
  for (Vec3& p : pyr) p = turned(p);
  EXPECT_NEAR(mean_ratio_hex(hex), mean_ratio_hex(box(2)), 1e-14);
  EXPECT_NEAR(mean_ratio_wedge(wedge), mean_ratio_wedge(prism(2)), 1e-14);
  EXPECT_NEAR(mean_ratio_pyramid(pyr), mean_ratio_pyramid(pyramid(2)), 1e-14);
}

TEST(ElementShape, DistributionsAreThoseOfTheSortedValues) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> height(.01, 1);
  Mesh mesh;
  std::array<std::vector<double>, 2> ratios;
  for (int n = 0; n < 4321; ++n) {
    auto tet = kCorner;
    tet[3].z = height(random);
    add_tet(mesh, tet, 3.0 * n, n % 3 == 0 ? 5 : 2);
    ratios[n % 3 == 0].push_back(mean_ratio_tet(tet));
  }
  const MeshShape shape = shape_of(mesh);
  const auto check = [](std::vector<double> values, const ShapeDistribution& found) {
    std::sort(values.begin(), values.end());
    const auto rank = [&](double percent) {
      return values[static_cast<std::size_t>(std::ceil(percent / 100 * values.size())) - 1];
    };
    EXPECT_NEAR(found.min, values[0], 1e-6);
    EXPECT_NEAR(found.p0_1, rank(.1), 1e-6);
    EXPECT_NEAR(found.p1, rank(1), 1e-6);
    EXPECT_NEAR(found.p5, rank(5), 1e-6);
    EXPECT_NEAR(found.median, rank(50), 1e-6);
    const auto below = std::count_if(values.begin(), values.end(), [](double v) { return v < .3; });
    EXPECT_NEAR(found.below_0_3_percent, 100.0 * below / values.size(), 1e-12);
  };
  check(ratios[0], shape.per_label[0].mean_ratio.value());
  check(ratios[1], shape.per_label[1].mean_ratio.value());
  ratios[0].insert(ratios[0].end(), ratios[1].begin(), ratios[1].end());
  check(ratios[0], shape.all.mean_ratio.value());
}

TEST(ElementShape, EdgeRatiosOfAThousandTets) {
  // 985 corners, whose ratio is sqrt(2), and 15 that are 3, 4, ... 17 times as high.
  Mesh mesh;
  for (int n = 0; n < 1000; ++n) {
    auto tet = kCorner;
    tet[3].z = n < 985 ? 1 : n - 982;
    add_tet(mesh, tet, 3.0 * n, 2);
  }
  const auto ratios = test::judge(mesh, test::two_boxes(), {false, false})["quality"]["edge_ratio"];
  EXPECT_NEAR(ratios["median"].get<double>(), std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(ratios["p99"].get<double>(), std::sqrt(1 + 7.0 * 7), 1e-6);  // the fifth of the fifteen
  EXPECT_NEAR(ratios["max"].get<double>(), std::sqrt(1 + 17.0 * 17), 1e-5);
}

TEST(ElementShape, MixedMeshHasItsKindsApart) {
  Mesh mesh;
  add_tet(mesh, kCorner, 0, 2);
  const auto h = add_points(mesh, box(2), 10);
  mesh.hexes.add({h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7]}, 1);
  const auto w = add_points(mesh, prism(1), 20);
  mesh.wedges.add({w[0], w[1], w[2], w[3], w[4], w[5]}, 1);
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  EXPECT_NEAR(quality["mean_ratio"]["min"].get<double>(), 3 * std::pow(2, 2.0 / 3) / 6, 1e-7);
  const auto& kinds = quality["shape_per_kind"];
  EXPECT_NEAR(kinds["wedges"]["mean_ratio"]["min"].get<double>(), 1, 1e-7);
  EXPECT_NEAR(kinds["hexes"]["edge_ratio"]["max"].get<double>(), 2, 1e-7);
  EXPECT_TRUE(kinds["pyramids"]["mean_ratio"].is_null());
  EXPECT_NEAR(quality["radius_ratio"]["min"].get<double>(), inverse_radius_ratio_tet(kCorner), 1e-7);
  EXPECT_TRUE(quality["per_label"][0]["radius_ratio"].is_null());
  EXPECT_NEAR(quality["per_label"][1]["height_ratio"]["median"].get<double>(), .5, 1e-7);
}

TEST(ElementShape, EmptyMeshHasNone) {
  const MeshShape shape = shape_of({});
  EXPECT_FALSE(shape.all.mean_ratio);
  EXPECT_FALSE(shape.all.edge_ratio);
}

TEST(ElementShape, CollapsedEdgeIsNull) {
  Mesh mesh;
  add_tet(mesh, {Vec3{}, Vec3{}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, 0, 1);
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  EXPECT_TRUE(quality["edge_ratio"]["max"].is_null());
  EXPECT_EQ(quality["mean_ratio"]["min"], 0);
}

}  // namespace
}  // namespace cbc3d::metrics
