#include "metrics/surface_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

// A closed surface and a point inside it; joined to tets.
struct Star {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 3>> facets;  // counter-clockwise seen from outside
};

Star icosahedron() {
  constexpr double kGolden = std::numbers::phi;
  Star star;
  for (const double s : {-1.0, 1.0}) {
    for (const double g : {-kGolden, kGolden}) {
      for (const Vec3& p : {Vec3{0, s, g}, Vec3{s, g, 0}, Vec3{g, 0, s}})
        star.points.push_back(p.normalized());
    }
  }
  const double side = 2 / std::sqrt(1 + kGolden * kGolden);
  const auto is_edge = [&](VertexId a, VertexId b) {
    return std::fabs((star.points[a] - star.points[b]).norm() - side) < 1e-9;
  };
  for (VertexId a = 0; a < 12; ++a) {
    for (VertexId b = a + 1; b < 12; ++b) {
      for (VertexId c = b + 1; c < 12; ++c) {
        if (!is_edge(a, b) || !is_edge(b, c) || !is_edge(a, c)) continue;
        const bool outwards = star.points[a].cross(star.points[b]).dot(star.points[c]) > 0;
        star.facets.push_back(outwards ? std::array<VertexId, 3>{a, b, c} : std::array<VertexId, 3>{a, c, b});
      }
    }
  }
  return star;
}

// Every facet in four, new vertices on the unit sphere.
Star refined(const Star& star) {
  Star fine{star.points, {}};
  std::map<std::pair<VertexId, VertexId>, VertexId> middles;
  const auto middle = [&](VertexId a, VertexId b) {
    const auto [at, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<VertexId>(fine.points.size()));
    if (is_new) fine.points.push_back((star.points[a] + star.points[b]).normalized());
    return at->second;
  };
  for (const auto& [a, b, c] : star.facets) {
    const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& facet :
         {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      fine.facets.push_back(facet);
  }
  return fine;
}

Star sphere(int refinements) {
  Star star = icosahedron();
  for (int n = 0; n < refinements; ++n) star = refined(star);
  return star;
}

// Scaled about the origin, then moved.
Mesh mesh_of(const Star& star, double scale, const Vec3& centre) {
  Mesh mesh;
  for (const Vec3& p : star.points) mesh.points.push_back(centre + scale * p);
  const auto middle = static_cast<VertexId>(mesh.points.size());
  mesh.points.push_back(centre);
  for (const auto& [a, b, c] : star.facets) mesh.tets.add({middle, a, b, c}, 1);
  return mesh;
}

constexpr Vec3 kCentre{20, 20, 20};
constexpr double kRadius = 12;

// A smooth ball, which has no thin parts near the places that are planted.
LabelImage ball_image() {
  LabelImage image = test::empty_image({41, 41, 41}, {1, 1, 1}, {0, 1});
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels[v] = (image.frame.local_centre(at[0], at[1], at[2]) - kCentre).norm() < kRadius ? 1 : 0;
  }
  return image;
}

SurfaceShapes shapes_of(const Mesh& mesh, const LabelImage& image) {
  const MeshView view(mesh, image);
  return surface_shapes(view, image, extract_surface(view, sorted_facets(view)));
}

TEST(SurfaceShape, Icosahedron) {
  const SurfaceShapes found = shapes_of(mesh_of(sphere(0), kRadius, kCentre), ball_image());
  const double angle = std::acos(std::sqrt(5.0) / 3) * 180 / M_PI;
  EXPECT_EQ(found.outer.facets, 20);
  EXPECT_EQ(found.outer.edges, 30);
  for (const auto& figure :
       {found.outer.angle_rms_deg, found.outer.angle_p95_deg, found.outer.angle_max_deg}) {
    EXPECT_NEAR(figure.value(), angle, 1e-9);
  }
  EXPECT_EQ(found.outer.edges_over, (std::array<std::int64_t, 3>{0, 0, 0}));
  EXPECT_EQ(found.outer.off_corner, 0);
  EXPECT_NEAR(found.outer.mean_ratio_min.value(), 1, 1e-12);
  EXPECT_TRUE(found.places.empty());
}

TEST(SurfaceShape, AnglesOfASphereFallLikeTheFacetSize) {
  double coarser = shapes_of(mesh_of(sphere(1), kRadius, kCentre), ball_image()).outer.angle_rms_deg.value();
  for (int n = 2; n < 5; ++n) {
    const double rms =
        shapes_of(mesh_of(sphere(n), kRadius, kCentre), ball_image()).outer.angle_rms_deg.value();
    EXPECT_NEAR(coarser / rms, 2, .06);
    coarser = rms;
  }
}

TEST(SurfaceShape, CubeHasEdgesOfExactly90Degrees) {
  LabelImage image = test::empty_image({9, 9, 9}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {3, 3, 3}, {5, 5, 5}, 1);
  const SurfaceShapes found = shapes_of(test::kuhn_mesh(image), image);
  EXPECT_EQ(found.outer.facets, 6 * 9 * 2);
  EXPECT_EQ(found.outer.edges, found.outer.facets * 3 / 2);
  EXPECT_EQ(found.outer.edges_over, (std::array<std::int64_t, 3>{12 * 3, 0, 0}));
  EXPECT_NEAR(found.outer.angle_rms_deg.value(), 90 * std::sqrt(36.0 / 162), 1e-9);
  EXPECT_NEAR(found.outer.mean_ratio_median.value(), std::sqrt(3.0) / 2, 1e-12);
  EXPECT_EQ(found.outer.off_normal, 0);
  EXPECT_TRUE(found.places.empty());
}

// Two flat pyramids over a regular polygon, base to base.
Star lens_of(int corners, double height) {
  Star lens;
  lens.points = {{0, 0, height}, {0, 0, -height}};
  for (int n = 0; n < corners; ++n) {
    lens.points.push_back({std::cos(2 * M_PI * n / corners), std::sin(2 * M_PI * n / corners), 0});
  }
  for (int n = 0; n < corners; ++n) {
    const auto a = static_cast<VertexId>(2 + n), b = static_cast<VertexId>(2 + (n + 1) % corners);
    lens.facets.push_back({0, a, b});
    lens.facets.push_back({1, b, a});
  }
  return lens;
}

TEST(SurfaceShape, FacetsOfAFlatLensAreOffTheirVerticesNormals) {
  // At the rim the normals are radial, at the poles upright. Of n corners the mean of a facet's three normals
  // leans by atan(2 cos(pi / n)) from the axis, the facet by its slope.
  const double lean = std::atan(2 * std::cos(M_PI / 24)) * 180 / M_PI;
  for (const double height : {.02, .1}) {
    const double slope = std::atan(height / std::cos(M_PI / 24)) * 180 / M_PI;
    const bool is_off = lean - slope > 60;
    EXPECT_EQ(is_off, height == .02);
    const auto surface =
        test::judge(mesh_of(lens_of(24, height), 10, kCentre), ball_image(), {false, false})["surface"];
    EXPECT_EQ(surface["facets_off_normal_60_percent"], is_off ? 100.0 : 0.0);
    EXPECT_EQ(surface["facets_off_corner_60_percent"], 100.0);
    EXPECT_EQ(surface["facets_over_120_deg"], 24);
  }
}

TEST(SurfaceShape, PercentilesOfALargeCube) {
  // Of 18 * 16^2 edges one in 24 is an edge of the cube: the 95th percentile is 0, the 99th is 90
  // degrees.
  LabelImage image = test::empty_image({20, 20, 20}, {1, 1, 1}, {0, 1});
  test::fill_box(image, {2, 2, 2}, {17, 17, 17}, 1);
  const auto surface = test::judge(test::kuhn_mesh(image), image, {false, false})["surface"];
  EXPECT_EQ(surface["facet_angle_p95_deg"], 0.0);
  EXPECT_NEAR(surface["facet_angle_p99_deg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(surface["facet_angle_rms_deg"].get<double>(), 90 * std::sqrt(12 * 16 / (18.0 * 16 * 16)), 1e-9);
  EXPECT_EQ(surface["facets_over_60_deg"], 12 * 16);
  EXPECT_EQ(surface["facets_over_90_deg"], 0);
  EXPECT_EQ(surface["facets_over_120_deg"], 0);
  for (const char* key : {"min", "p1", "median"}) {
    EXPECT_NEAR(surface["facet_mean_ratio"][key].get<double>(), std::sqrt(3.0) / 2, 1e-7) << key;
  }
}

TEST(SurfaceShape, SlabRimIsOffAndOver90) {
  constexpr double kHeight = .2;
  const Star lens = lens_of(6, kHeight);
  const double slope = std::atan(kHeight / std::cos(M_PI / 6)) * 180 / M_PI;
  LabelImage plate = test::empty_image({41, 41, 41}, {1, 1, 1}, {0, 1});
  test::fill_box(plate, {10, 10, 20}, {30, 30, 20}, 1);
  const SurfaceShapes found = shapes_of(mesh_of(lens, 10, kCentre), plate);
  EXPECT_NEAR(found.outer.angle_max_deg.value(), 180 - 2 * slope, 1e-9);
  EXPECT_EQ(found.outer.edges_over, (std::array<std::int64_t, 3>{6, 6, 6}));
  ASSERT_EQ(found.places.size(), 1U);  // the whole rim hangs together
  EXPECT_EQ(found.places[0].kind, PlaceKind::kThinLabel);
  const SurfaceShapes unasked = shapes_of(mesh_of(lens, 10, kCentre), ball_image());
  ASSERT_EQ(unasked.places.size(), 1U);
  EXPECT_EQ(unasked.places[0].kind, PlaceKind::kSpike);
}

TEST(SurfaceShape, PlantedSpikeAndPit) {
  for (const auto& [factor, kind] : {std::pair(2.0, PlaceKind::kSpike), std::pair(.2, PlaceKind::kPit)}) {
    Star star = sphere(3);
    constexpr std::size_t kPlanted = 300;
    star.points[kPlanted] = factor * star.points[kPlanted];
    const Mesh mesh = mesh_of(star, kRadius, kCentre);
    const SurfaceShapes found = shapes_of(mesh, ball_image());
    ASSERT_EQ(found.places.size(), 1U) << factor;
    EXPECT_EQ(found.places[0].kind, kind);
    EXPECT_LT((found.places[0].at_mm - mesh.points[kPlanted]).norm(), 1e-9);
    EXPECT_GT(found.outer.off_corner, 0);
    EXPECT_GT(found.outer.edges_over[0], 0);
  }
}

TEST(SurfaceShape, PlacesAreNamed) {
  Star star = sphere(3);
  star.points[300] = 2 * star.points[300];
  const Mesh mesh = mesh_of(star, kRadius, kCentre);
  const auto surface = test::judge(mesh, ball_image(), {false, false})["surface"];
  EXPECT_EQ(surface["places"]["count"], 1);
  EXPECT_EQ(surface["places"]["not_asked"], 1);
  EXPECT_EQ(surface["places"]["spikes"], 1);
  const auto& place = surface["places"]["list"][0];
  EXPECT_EQ(place["label"], 1);
  EXPECT_EQ(place["kind"], "spike");
  EXPECT_NEAR(place["at_mm"][0].get<double>(), mesh.points[300].x, 1e-12);
  EXPECT_EQ(surface["per_label"][0]["label"], 1);
  EXPECT_EQ(surface["per_label"][0]["places_not_asked"], 1);
  EXPECT_EQ(surface["per_label"][0]["facet_angle_rms_deg"], surface["facet_angle_rms_deg"]);
  star.points[300] = .1 * star.points[300];
  const auto pit =
      test::judge(mesh_of(star, kRadius, kCentre), ball_image(), {false, false})["surface"]["places"];
  EXPECT_EQ(pit["pits"], 1);
  EXPECT_EQ(pit["spikes"], 0);
}

TEST(SurfaceShape, QuadFacets) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2}};
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  const SurfaceShapes found = shapes_of(mesh, test::two_boxes());
  EXPECT_EQ(found.outer.facets, 6);
  EXPECT_EQ(found.outer.edges, 12);
  EXPECT_NEAR(found.outer.angle_rms_deg.value(), 90, 1e-9);
  EXPECT_EQ(found.outer.edges_over, (std::array<std::int64_t, 3>{12, 0, 0}));
  EXPECT_NEAR(found.outer.mean_ratio_min.value(), 2 * 2 / 5.0, 1e-12);
}

TEST(SurfaceShape, InterfacesBelongToBothLabelsAndNotToTheOuterSurface) {
  const LabelImage image = test::two_boxes();
  const SurfaceShapes found = shapes_of(test::kuhn_mesh(image), image);
  const std::int64_t interface = 2 * 4 * 3;
  EXPECT_EQ(found.per_label[0].facets + found.per_label[1].facets, found.outer.facets + 2 * interface);
}

TEST(SurfaceShape, EmptyMesh) {
  const SurfaceShapes found = shapes_of({}, test::two_boxes());
  EXPECT_EQ(found.outer.facets, 0);
  EXPECT_FALSE(found.outer.angle_rms_deg);
  EXPECT_FALSE(found.outer.mean_ratio_min);
}

}  // namespace
}  // namespace cbc3d::metrics
