#include "metrics/certified_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/surface_hausdorff.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

SearchableSurface<Triangle> surface_of(const std::vector<Triangle>& triangles) {
  std::vector<SmoothTriangle> list;
  list.reserve(triangles.size());
  for (const Triangle& t : triangles) list.push_back({t, kBackground, {}});
  return searchable_triangles(list);
}

DistanceBounds bounds_of(const std::vector<Triangle>& from, const std::vector<Triangle>& to,
                         const CertifyOptions& options = {1e-4, 20'000'000}) {
  const auto found = surface_distance(surface_of(from), surface_of(to), options);
  return found.value().image_to_mesh.bounds.value();
}

void expect_around(const DistanceBounds& bounds, double truth, double tolerance = 1e-4) {
  EXPECT_LE(bounds.lower_mm, truth + 1e-12);
  EXPECT_GE(bounds.upper_mm, truth - 1e-12);
  EXPECT_LE(bounds.upper_mm - bounds.lower_mm, tolerance + 1e-12);
}

std::vector<Triangle> rectangle(const Vec3& corner, const Vec3& u, const Vec3& v) {
  return {{corner, corner + u, corner + u + v}, {corner, corner + u + v, corner + v}};
}

std::vector<Triangle> cube_surface(double half) {
  std::vector<Triangle> all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-half, half}) {
      Vec3 corner{-half, -half, -half}, u{}, v{};
      corner[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 2 * half;
      const auto face = rectangle(corner, u, v);
      all.insert(all.end(), face.begin(), face.end());
    }
  }
  return all;
}

TEST(CertifiedDistance, FarthestPointInsideAFacet) {
  // Every vertex of the square lies on one of the two strips; its middle line is 1 from both.
  const auto square = rectangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0});
  auto strips = rectangle({0, 0, 0}, {0, 2, 0}, {0, 0, 1});
  const auto other = rectangle({2, 0, 0}, {0, 2, 0}, {0, 0, 1});
  strips.insert(strips.end(), other.begin(), other.end());
  expect_around(bounds_of(square, strips), 1);
}

TEST(CertifiedDistance, PlaneAtAnAngle) {
  // Over a wide floor the distance of a tilted rectangle is that of its highest edge.
  for (const double degrees : {5.0, 30.0, 77.0}) {
    const double angle = degrees * M_PI / 180;
    const auto tilted = rectangle({1, 1, 0}, {3 * std::cos(angle), 0, 3 * std::sin(angle)}, {0, 2, 0});
    expect_around(bounds_of(tilted, rectangle({-9, -9, 0}, {30, 0, 0}, {0, 30, 0})), 3 * std::sin(angle));
  }
}

TEST(CertifiedDistance, NestedCubes) {
  expect_around(bounds_of(cube_surface(3), cube_surface(2)), std::sqrt(3.0));
  expect_around(bounds_of(cube_surface(2), cube_surface(3)), 1);
}

TEST(CertifiedDistance, ConcentricSpheres) {
  // Everywhere equally far: nothing is pruned early. A chord lies below its sphere by the sagitta.
  const auto inner = test::sphere_triangles(2, 24), outer = test::sphere_triangles(3, 24);
  const CertifyOptions options{.01, 20'000'000};
  const auto in_out = bounds_of(inner, outer, options), out_in = bounds_of(outer, inner, options);
  EXPECT_NEAR(in_out.lower_mm, 1, .02);
  EXPECT_NEAR(out_in.upper_mm, 1, .03);
  EXPECT_LE(in_out.upper_mm - in_out.lower_mm, .01 + 1e-12);
  EXPECT_LE(out_in.upper_mm - out_in.lower_mm, .01 + 1e-12);
}

// Largest over a barycentric grid on each triangle of the distance to all triangles.
double brute_force(const std::vector<Triangle>& from, const std::vector<Triangle>& to, int steps) {
  double largest = 0;
  for (const Triangle& t : from) {
    for (int u = 0; u <= steps; ++u) {
      for (int v = 0; u + v <= steps; ++v) {
        const Vec3 p = t.a + double(u) / steps * (t.b - t.a) + double(v) / steps * (t.c - t.a);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Triangle& other : to) nearest = std::min(nearest, other.squared_distance(p));
        largest = std::max(largest, nearest);
      }
    }
  }
  return std::sqrt(largest);
}

std::vector<Triangle> random_triangles(std::mt19937& random, int count, double extent) {
  const auto draw = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Triangle> triangles;
  for (int n = 0; n < count; ++n) {
    const Vec3 at{5 * draw(), 5 * draw(), 5 * draw()};
    const auto near = [&] { return at + extent * Vec3{draw(), draw(), draw()}; };
    triangles.push_back({near(), near(), near()});
  }
  return triangles;
}

TEST(CertifiedDistance, AgreesWithBruteForce) {
  std::mt19937 random(21);
  for (int round = 0; round < 12; ++round) {
    const auto from = random_triangles(random, 25, round % 2 == 0 ? 1 : 4);
    const auto to = random_triangles(random, 30, round % 3 == 0 ? 1 : 3);
    constexpr int kSteps = 40;
    const double sampled = brute_force(from, to, kSteps);
    const auto found = bounds_of(from, to);
    EXPECT_GE(found.upper_mm, sampled - 1e-12);
    EXPECT_LE(found.upper_mm - found.lower_mm, 1e-4 + 1e-12);
    // A point of a triangle is no farther from the grid than its longest edge over the steps.
    EXPECT_LE(found.lower_mm, sampled + 4 * std::sqrt(3.0) / kSteps);
    EXPECT_LE(found.lower_mm, found.upper_mm);
  }
}

TEST(CertifiedDistance, BoundsHoldWhenThePiecesRunOut) {
  // The farthest point is where the distances to three of the small triangles at the corners are equal.
  const auto square = rectangle({0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  std::vector<Triangle> corners;
  for (const Vec3& at : {Vec3{-.3, .1, 0}, Vec3{10.2, -.5, 1}, Vec3{.7, 9.6, -1}, Vec3{9.1, 10.4, .5}})
    corners.push_back({at, at + Vec3{.1, 0, 0}, at + Vec3{0, .1, 0}});
  const auto exact = bounds_of(square, corners, {1e-6, 20'000'000});
  const auto rough = bounds_of(square, corners, {1e-6, 1});
  EXPECT_LE(exact.upper_mm - exact.lower_mm, 1e-6 + 1e-12);
  EXPECT_LE(rough.lower_mm, exact.upper_mm);
  EXPECT_GE(rough.upper_mm, exact.lower_mm);
  EXPECT_GT(rough.upper_mm - rough.lower_mm, 1e-6);
}

TEST(CertifiedDistance, VoxelFacesAgainstTriangles) {
  // A box of voxels shifted by a quarter along x.
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  for (Vec3& p : mesh.points) p.x += .25;
  EvaluateOptions options;
  options.tolerance_mm = 1e-3;
  const auto fidelity = test::judge(mesh, image, options)["fidelity"];
  EXPECT_NEAR(fidelity["surface_hausdorff_bounds_mm"][0].get<double>(), .25, 1e-12);
  EXPECT_NEAR(fidelity["surface_hausdorff_bounds_mm"][1].get<double>(), .25, 1e-3);
  // Per interface the walls move apart alike; the ends of the shifted side walls are a quarter off.
  ASSERT_EQ(fidelity["per_interface"].size(), 3U);
  EXPECT_EQ(fidelity["per_interface"][2]["labels"], nlohmann::json({1, 7}));
  const auto& between = fidelity["per_interface"][2]["voxel_surface"]["image_to_mesh"];
  EXPECT_NEAR(between["mean_mm"].get<double>(), .25, 1e-12);
  EXPECT_NEAR(between["rms_mm"].get<double>(), .25, 1e-12);
  EXPECT_NEAR(between["p95_mm"].get<double>(), .25, 1e-12);
  EXPECT_NEAR(fidelity["per_interface"][2]["mesh_area_mm2"].get<double>(), 4 * .5 * 3 * 2, 1e-12);
}

TEST(SurfaceDistance, WeightsAreAreas) {
  // A long thin and a small facet over a floor: the mean height of the whole, not of the samples.
  auto raised = rectangle({0, 0, 1}, {10, 0, 0}, {0, 1, 0});
  const auto step = rectangle({0, 2, 3}, {1, 0, 0}, {0, 1, 0});
  raised.insert(raised.end(), step.begin(), step.end());
  const auto found =
      surface_distance(surface_of(raised), surface_of(rectangle({-5, -5, 0}, {40, 0, 0}, {0, 40, 0})), {});
  EXPECT_NEAR(found.value().image_to_mesh.mean_mm, (10 * 1 + 1 * 3) / 11.0, 1e-12);
  EXPECT_NEAR(found.value().image_to_mesh.rms_mm, std::sqrt((10 * 1 + 1 * 9) / 11.0), 1e-12);
  EXPECT_NEAR(found.value().image_to_mesh.p95_mm, 3, 1e-12);  // 1/11 of the area is that far
  EXPECT_NEAR(found.value().image_to_mesh.area_mm2, 11, 1e-12);
}

}  // namespace
}  // namespace cbc3d::metrics
