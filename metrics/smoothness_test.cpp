#include "metrics/smoothness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "metrics/shape_deviation.hpp"
#include "metrics/smooth_surface.hpp"
#include "metrics/surface_hausdorff.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

LabelImage image_of(int n, double spacing, const std::function<int(const Vec3&)>& material) {
  LabelImage image = test::empty_image({n, n, n}, {spacing, spacing, spacing}, {0, 1, 2});
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels[v] = static_cast<MaterialId>(material(image.frame.local_centre(at[0], at[1], at[2])));
  }
  return image;
}

double area_of(const std::vector<SmoothTriangle>& triangles) {
  double area = 0;
  for (const auto& t : triangles)
    area += .5 * (t.triangle.b - t.triangle.a).cross(t.triangle.c - t.triangle.a).norm();
  return area;
}

TEST(SmoothSurface, BallAndTorusHaveTheirAreas) {
  const Vec3 centre{12, 12, 12};
  const auto ball =
      smooth_surface(image_of(49, .5, [&](const Vec3& p) { return (p - centre).norm() < 8 ? 1 : 0; }), 1);
  EXPECT_NEAR(area_of(ball), 4 * M_PI * 64, .02 * 4 * M_PI * 64);
  for (const auto& t : ball) EXPECT_NEAR((t.triangle.a - centre).norm(), 8, .5);
  const auto ring = smooth_surface(image_of(49, .5,
                                            [&](const Vec3& p) {
                                              const Vec3 d = p - centre;
                                              return std::hypot(std::hypot(d.x, d.y) - 7, d.z) < 3 ? 1 : 0;
                                            }),
                                   1);
  // Smoothing draws a tube of 6 voxels in by about 1/12 voxel, 1.4 % of its area.
  EXPECT_NEAR(area_of(ring), 4 * M_PI * M_PI * 21, .03 * 4 * M_PI * M_PI * 21);
}

TEST(SmoothSurface, PlaneAtAnAngleIsFlat) {
  for (const Vec3& direction : {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{3, 1, 0}, Vec3{5, 2, 1}}) {
    const Vec3 normal = direction.normalized(), centre{10, 10, 10};
    const auto plane = smooth_surface(
        image_of(21, 1, [&](const Vec3& p) { return normal.dot(p - centre) < .1 ? 1 : 0; }), 1);
    double area = 0, projected = 0, farthest = 0;
    for (const auto& [triangle, other, corner] : plane) {
      const Vec3 middle = (triangle.a + triangle.b + triangle.c) / 3;
      if ((middle - centre).max_coeff() > 5 || (centre - middle).max_coeff() > 5) continue;
      const Vec3 vector = .5 * (triangle.b - triangle.a).cross(triangle.c - triangle.a);
      area += vector.norm();
      projected += std::fabs(vector.dot(normal));
      farthest = std::max(farthest, std::fabs(normal.dot(middle - centre) - .1));
    }
    EXPECT_GT(projected, 50);
    EXPECT_LT(area / projected, 1.03);  // the voxel faces have 1.27 to 1.73
    EXPECT_LT(farthest, .6);
  }
}

TEST(SmoothSurface, NothingIsLostHoweverThin) {
  const LabelImage wire =
      image_of(12, 1, [](const Vec3& p) { return p.x == 5 && p.y == 5 && p.z > 1 && p.z < 10; });
  const auto found = smooth_surface(wire, 1);
  EXPECT_EQ(smoothness(numbered_facets(found)).value().edges,
            static_cast<std::int64_t>(found.size() * 3 / 2));  // closed
  double low = 99, high = -99;
  for (const auto& t : found) {
    low = std::min({low, t.triangle.a.z, t.triangle.b.z, t.triangle.c.z});
    high = std::max({high, t.triangle.a.z, t.triangle.b.z, t.triangle.c.z});
    EXPECT_LE(std::hypot(t.triangle.a.x - 5, t.triangle.a.y - 5), .71);
  }
  EXPECT_LT(low, 2);
  EXPECT_GT(high, 9);
}

TEST(SmoothSurface, OneSurfaceBetweenTwoLabels) {
  const Vec3 normal = Vec3{2, 1, .5}.normalized();
  const LabelImage image = image_of(16, 1, [&](const Vec3& p) {
    if (p.min_coeff() < 2 || p.max_coeff() > 13) return 0;
    return normal.dot(p - Vec3{7.5, 7.5, 7.5}) < 0 ? 1 : 2;
  });
  // Where three materials meet each of the labels ends the surface on its own.
  const auto far_from_background = [](const SmoothTriangle& t) {
    return t.triangle.a.min_coeff() > 4 && t.triangle.a.max_coeff() < 11;
  };
  std::vector<SmoothTriangle> from_one, from_two;
  for (const auto& t : smooth_surface(image, 1))
    if (t.other == 2 && far_from_background(t)) from_one.push_back(t);
  for (const auto& t : smooth_surface(image, 2))
    if (t.other == 1 && far_from_background(t)) from_two.push_back(t);
  ASSERT_GT(from_one.size(), 40U);
  const auto found = surface_distance(searchable_triangles(from_one), searchable_triangles(from_two), {});
  EXPECT_LT(found.value().mean_mm(), .02);
  EXPECT_LT(found.value().hd95_mm(), .05);
}

TEST(SmoothSurface, FillsTheImage) {
  const LabelImage full = image_of(5, 1, [](const Vec3&) { return 1; });
  const auto found = smooth_surface(full, 1);
  EXPECT_EQ(smoothness(numbered_facets(found)).value().edges,
            static_cast<std::int64_t>(found.size() * 3 / 2));
  EXPECT_TRUE(smooth_surface(full, 0).empty());
  EXPECT_TRUE(smooth_surface(full, 2).empty());
}

std::vector<NumberedFacet> numbered(const std::vector<Triangle>& triangles) {
  std::map<std::array<long, 3>, std::uint64_t> numbers;
  const auto number = [&numbers](const Vec3& p) {
    return numbers
        .try_emplace({std::lround(p.x * 1e6), std::lround(p.y * 1e6), std::lround(p.z * 1e6)}, numbers.size())
        .first->second;
  };
  std::vector<NumberedFacet> facets;
  facets.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    facets.push_back({{number(a), number(b), number(c), NumberedFacet::kNoCorner}, {a, b, c, c}});
  return facets;
}

TEST(Smoothness, SphereBendsByItsRadiusAtAnyMeshSize) {
  double before = 1e9;
  for (const int n : {8, 16, 32}) {
    const auto found = smoothness(numbered(test::sphere_triangles(5, n)));
    EXPECT_NEAR(found.value().bending_per_mm, 1.0 / 5, .03 / 5 * 32 / n);
    EXPECT_LT(found.value().mean_angle_deg, .7 * before);  // halves with the facets
    before = found.value().mean_angle_deg;
  }
}

TEST(Smoothness, Cube) {
  // Twelve edges of 90 degrees and length 3, six flat diagonals of length 3 sqrt(2).
  const LabelImage image = [] {
    LabelImage one = test::empty_image({3, 3, 3}, {3, 3, 3}, {0, 1});
    test::fill_box(one, {1, 1, 1}, {1, 1, 1}, 1);
    return one;
  }();
  const auto row = test::judge(test::kuhn_mesh(image), image)["fidelity"]["per_label"][0]["smoothness"];
  const double sharp = 12 * 3, flat = 6 * 3 * std::sqrt(2.0);
  EXPECT_NEAR(row["facet_angle_mean_deg"].get<double>(), 90 * sharp / (sharp + flat), 1e-9);
  EXPECT_NEAR(row["facet_angle_rms_deg"].get<double>(), 90 * std::sqrt(sharp / (sharp + flat)), 1e-9);
  EXPECT_NEAR(row["facet_angle_p95_deg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(row["facet_angle_max_deg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(row["bending_per_mm"].get<double>(), M_PI / (2 * 3), 1e-12);
}

TEST(Smoothness, VoxelStepsAreRoughHoweverFine) {
  for (const double spacing : {1.0, .5}) {
    const int n = static_cast<int>(24 / spacing);
    const Vec3 centre{11.5, 11.5, 11.5};
    const LabelImage image =
        image_of(n, spacing, [&](const Vec3& p) { return (p - centre).norm() < 9 ? 1 : 0; });
    const auto row =
        test::judge(test::kuhn_mesh(image), image, {true, false})["fidelity"]["per_label"][0]["smoothness"];
    EXPECT_NEAR(row["area_excess_percent"].get<double>(), 50, 4);  // a ball of voxels has 6 pi r^2
    EXPECT_GT(row["bending_ratio"].get<double>(), 3);
    // The facets of the smooth surface are half a voxel small and so not quite smooth themselves.
    EXPECT_GT(row["smooth_bending_per_mm"].get<double>(), .99 / 9);
    EXPECT_LT(row["smooth_bending_per_mm"].get<double>(), 2.0 / 9);
  }
}

TEST(ShapeDeviation, BallOfTets) {
  const double radius = 6;
  const Vec3 centre{1, -2, 3};
  Mesh mesh;
  mesh.points = {centre};
  for (const auto& [a, b, c] : test::sphere_triangles(radius, 20)) {  // a fan from the centre
    const auto v = static_cast<VertexId>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {centre + a, centre + b, centre + c});
    mesh.tets.add({v, v + 1, v + 2, 0}, 4);
    if (six_volumes(mesh.points[v], mesh.points[v + 1], mesh.points[v + 2], centre) < 0)
      std::swap(mesh.tets.nodes.back()[0], mesh.tets.nodes.back()[1]);
  }
  // Every tet has vertices of its own; the sides within the ball are left out by labelling each tet's outer
  // facet alone: the surface is taken of the facets whose vertices are all on the sphere.
  const MeshView view(mesh, test::two_boxes());
  Surface surface = extract_surface(view, sorted_facets(view));
  std::erase_if(surface.facets_of[0], [&](std::uint32_t f) {
    const auto& nodes = surface.facets[f].nodes;
    return nodes[0] == 0 || nodes[1] == 0 || nodes[2] == 0;
  });
  const auto found = shape_deviations(view, surface,
                                      {{4, [&](const Vec3& p) { return (p - centre).norm() - radius; }},
                                       {9, [](const Vec3&) { return 0.0; }}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].label, 4);
  EXPECT_NEAR(found[0].shape_area_mm2, 4 * M_PI * radius * radius, 1e-3 * 4 * M_PI * radius * radius);
  EXPECT_NEAR(found[0].area_excess_percent, 100 * (found[0].mesh_area_mm2 / (4 * M_PI * 36) - 1), .1);
  EXPECT_LT(found[0].mean_normal_deviation_deg, 3);
  EXPECT_GT(found[0].mean_normal_deviation_deg, .3);
  EXPECT_LT(found[0].max_distance_mm, .1);
}

// The icosahedron with every facet in n x n, blown up to a sphere about the origin; outward.
std::vector<OutwardTriangle> icosphere(double radius, int n) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const std::array<Vec3, 12> corner{{{0, 1, g},
                                     {0, 1, -g},
                                     {0, -1, g},
                                     {0, -1, -g},
                                     {1, g, 0},
                                     {1, -g, 0},
                                     {-1, g, 0},
                                     {-1, -g, 0},
                                     {g, 0, 1},
                                     {-g, 0, 1},
                                     {g, 0, -1},
                                     {-g, 0, -1}}};
  std::vector<OutwardTriangle> triangles;
  const auto near = [&](std::size_t a, std::size_t b) { return (corner[a] - corner[b]).norm() < 2.1; };
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 p = radius * a.normalized(), q = radius * b.normalized(), r = radius * c.normalized();
    triangles.push_back(p.dot(q.cross(r)) > 0 ? OutwardTriangle{p, q, r} : OutwardTriangle{p, r, q});
  };
  for (std::size_t a = 0; a < 12; ++a) {
    for (std::size_t b = a + 1; b < 12; ++b) {
      for (std::size_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const Vec3 u = (corner[b] - corner[a]) / n, v = (corner[c] - corner[a]) / n;
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            const Vec3 p = corner[a] + i * u + j * v;
            add(p, p + u, p + v);
            if (i + j + 1 < n) add(p + u, p + u + v, p + v);
          }
        }
      }
    }
  }
  return triangles;
}

// Mean angle between a facet's normal and the direction from the origin, by enough points that no rule is
// needed.
double mean_angle_deg(const std::vector<OutwardTriangle>& triangles) {
  constexpr int kSteps = 40;
  double sum = 0, area = 0;
  for (const auto& [a, b, c] : triangles) {
    const Vec3 vector = (b - a).cross(c - a);
    const auto add = [&](double u, double v) {
      const Vec3 p = a + u / kSteps * (b - a) + v / kSteps * (c - a);
      sum += std::acos(std::min(1.0, p.normalized().dot(vector.normalized()))) * vector.norm();
      area += vector.norm();
    };
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; i + j < kSteps; ++j) {
        add(i + 1 / 3.0, j + 1 / 3.0);
        if (i + j + 1 < kSteps) add(i + 2 / 3.0, j + 2 / 3.0);
      }
    }
  }
  return sum / area * 180 / M_PI;
}

TEST(ShapeDeviation, FineSphereIsSmoothAsItsFacetsAreSmall) {
  const double radius = 20;
  const auto sphere = [&](const Vec3& p) { return p.norm() - radius; };
  for (const int n : {1, 4, 12}) {
    const auto triangles = icosphere(radius, n);
    ASSERT_EQ(triangles.size(), static_cast<std::size_t>(20 * n * n));
    const ShapeDeviation found = shape_deviation(triangles, sphere, {});
    const double expected = mean_angle_deg(triangles);
    EXPECT_NEAR(found.mean_normal_deviation_deg, expected, .04 * expected) << n;  // 3 % is the rule's own
    // Over equilateral triangles on a sphere: .9201 times their inner radius, over the sphere's.
    const double side =
        std::sqrt(found.mesh_area_mm2 / static_cast<double>(triangles.size()) * 4 / std::sqrt(3));
    const double by_theory = .9201 * side / std::sqrt(12) / radius * 180 / M_PI;
    EXPECT_NEAR(found.mean_normal_deviation_deg, by_theory, (n == 1 ? .2 : .07) * by_theory) << n;
    // Corners on the sphere: less area than it has, as much as its polyhedron lacks.
    const double lack = 100 * (found.mesh_area_mm2 / (4 * M_PI * radius * radius) - 1);
    EXPECT_LT(found.area_excess_percent, 0);
    EXPECT_NEAR(found.area_excess_percent, lack, n == 1 ? 6 : .02 * -lack) << n;
  }
  EXPECT_LT(shape_deviation(icosphere(radius, 40), sphere, {}).mean_normal_deviation_deg, .5);
  EXPECT_NEAR(shape_deviation(icosphere(radius, 40), sphere, {}).area_excess_percent, 0, .03);
}

TEST(ShapeDeviation, WrinklesCountAndAShellHasTwoSides) {
  // Every corner of the sphere in or out by a little: normals turn, area grows.
  const double radius = 20;
  const auto shell = [&](const Vec3& p) { return std::max(p.norm() - radius, radius / 2 - p.norm()); };
  auto triangles = icosphere(radius, 16);
  const ShapeDeviation smooth = shape_deviation(triangles, shell, {});
  auto inner = icosphere(radius / 2, 16);
  for (OutwardTriangle& t : inner) std::swap(t[1], t[2]);  // away from the shell is inwards here
  const ShapeDeviation inside = shape_deviation(inner, shell, {});
  EXPECT_NEAR(inside.mean_normal_deviation_deg, smooth.mean_normal_deviation_deg, 1e-6);
  EXPECT_NEAR(inside.area_excess_percent, smooth.area_excess_percent, .01);
  for (OutwardTriangle& t : triangles) {
    for (Vec3& p : t) p *= 1 + .01 * std::sin(97 * p.x + 61 * p.y + 31 * p.z);
  }
  const ShapeDeviation rough = shape_deviation(triangles, shell, {});
  EXPECT_GT(rough.mean_normal_deviation_deg, smooth.mean_normal_deviation_deg + 3);
  const double excess = 100 * (rough.mesh_area_mm2 / (4 * M_PI * radius * radius) - 1);
  EXPECT_GT(excess, 1);
  EXPECT_NEAR(rough.area_excess_percent, excess, .2);
}

TEST(ShapeDeviation, BallOfVoxels) {
  // Voxel faces over a ball: weighted by |n_z| the mean of acos |n_z| is pi/4, and the area is 3/2.
  const Vec3 centre{15.3, 15.1, 14.8};
  const auto ball = [&](const Vec3& p) { return (p - centre).norm() - 13; };
  const LabelImage image = image_of(31, 1, [&](const Vec3& p) { return ball(p) < 0 ? 1 : 0; });
  const Mesh mesh = test::kuhn_mesh(image);
  const MeshView view(mesh, image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  const auto found = shape_deviations(view, surface, {{1, ball}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].mean_normal_deviation_deg, 45, 1);
  EXPECT_NEAR(found[0].area_excess_percent, 50, 2);
  EXPECT_NEAR(found[0].shape_area_mm2, 4 * M_PI * 169, .02 * 4 * M_PI * 169);
}

}  // namespace
}  // namespace cbc3d::metrics
