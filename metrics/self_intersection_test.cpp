#include "metrics/self_intersection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesher/core/runtime.hpp"
#include "metrics/exact_orientation.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

using Points = std::vector<Vec3>;

// All ways to name the corners, and which is the first.
void expect_meet(const Corners& a, const Corners& b, bool expected) {
  std::array<std::size_t, 3> i{0, 1, 2};
  do {
    std::array<std::size_t, 3> j{0, 1, 2};
    do {
      const Corners one{a[i[0]], a[i[1]], a[i[2]]}, other{b[j[0]], b[j[1]], b[j[2]]};
      EXPECT_EQ(triangles_intersect(one, other), expected);
      EXPECT_EQ(triangles_intersect(other, one), expected);
    } while (std::next_permutation(j.begin(), j.end()));
  } while (std::next_permutation(i.begin(), i.end()));
}

const Corners kBase{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{0, 4, 0}};

TEST(SelfIntersection, CrossingTouchingAndApart) {
  expect_meet(kBase, {Vec3{1, 1, -1}, Vec3{1, 1, 1}, Vec3{5, 5, 1}}, true);      // an edge through the face
  expect_meet(kBase, {Vec3{-1, 1, -1}, Vec3{-1, 1, 1}, Vec3{5, 1.5, 0}}, true);  // a blade across it
  expect_meet(kBase, {Vec3{1, 1, 0}, Vec3{1, 1, 1}, Vec3{2, 1, 1}}, true);       // a corner within the face
  expect_meet(kBase, {Vec3{2, 0, 0}, Vec3{2, 0, 1}, Vec3{2, -1, 1}}, true);      // a corner within an edge
  expect_meet(kBase, {Vec3{2, -1, -1}, Vec3{2, 1, 1}, Vec3{2, -1, 1}}, true);    // edges crossing in a point
  expect_meet(kBase, {Vec3{1, 1, 1}, Vec3{2, 1, 1}, Vec3{1, 2, 1}}, false);      // parallel
  expect_meet(kBase, {Vec3{3, 3, -1}, Vec3{3, 3, 1}, Vec3{5, 5, 1}}, false);     // past the long edge
  expect_meet(kBase, {Vec3{9, 9, -1}, Vec3{9, 9, 1}, Vec3{8, 9, 0}}, false);
}

TEST(SelfIntersection, InOnePlane) {
  expect_meet(kBase, {Vec3{1, 1, 0}, Vec3{1.5, 1, 0}, Vec3{1, 1.5, 0}}, true);  // within
  expect_meet(kBase, {Vec3{-1, 1, 0}, Vec3{5, 1, 0}, Vec3{5, 2, 0}}, true);     // no corner in the other
  expect_meet(kBase, {Vec3{2, 2, 0}, Vec3{5, 5, 0}, Vec3{5, 4, 0}}, true);      // a corner within an edge
  expect_meet(kBase, {Vec3{1, 0, 0}, Vec3{3, 0, 0}, Vec3{2, -1, 0}}, true);     // parts of edges
  expect_meet(kBase, {Vec3{3, 3, 0}, Vec3{5, 5, 0}, Vec3{5, 4, 0}}, false);
  expect_meet(kBase, {Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}, false);  // edges on one line, apart
}

TEST(SelfIntersection, WithCommonCorners) {
  // One: apart, cutting with the opposite edge, in one plane beside and over each other, along an edge.
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{-1, 0, 1}, Vec3{0, -1, 1}}, false);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{1, 1, -1}, Vec3{1, 1, 1}}, true);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{9, 9, -1}, Vec3{9, 9, 1}}, true);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}}, false);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{9, 1, 0}, Vec3{9, -1, 0}}, true);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 0, 1}}, true);
  // Two: folded at any angle but flat back.
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 1, 1e-300}}, false);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, -1, 0}}, false);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{1, 1, 0}}, true);
  expect_meet(kBase, {Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{9, 9, 0}}, true);
  // The same one, and one without area.
  expect_meet(kBase, kBase, false);
  expect_meet(kBase, {Vec3{1, 1, -1}, Vec3{1, 1, 0}, Vec3{1, 1, 1}}, false);
}

TEST(SelfIntersection, ALastBitDecides) {
  const auto next = [](double x, double to) { return std::nextafter(x, to); };
  constexpr double kUp = std::numeric_limits<double>::infinity();
  const Corners sloped{Vec3{0, 0, 0}, Vec3{3, 1, 0.25}, Vec3{1, 3, 0.75}};
  const Vec3 within{2, 2, 0.5};  // exactly the middle of an edge
  const auto needle = [](const Vec3& tip) { return Corners{tip, tip + Vec3{0, 0, 1}, tip + Vec3{.5, 0, 2}}; };
  expect_meet(sloped, needle(within), true);
  expect_meet(sloped, needle({2, 2, next(0.5, 0)}), true);
  expect_meet(sloped, needle({2, 2, next(0.5, kUp)}), false);
  // Beside the edge by one bit.
  EXPECT_EQ(orientation(sloped[0], sloped[1], sloped[2], {2, 2, next(0.5, kUp)}), 1);
  EXPECT_EQ(orientation(sloped[0], sloped[1], sloped[2], within), 0);
  EXPECT_EQ(orientation(sloped[0], sloped[1], sloped[2], {2, 2, next(0.5, 0)}), -1);
}

// Against integers: coordinates are k / 2^40 with k below 2^38, so that 128 bits hold the determinant.
TEST(SelfIntersection, OrientationIsExactNearItsPlane) {
  std::mt19937_64 random(7);
  const auto any = [&] { return static_cast<std::int64_t>(random() >> 26U) - (std::int64_t{1} << 37U); };
  using Whole = std::array<std::int64_t, 3>;
  using Wide = __int128;
  const auto real = [](const Whole& p) { return 0x1p-40 * Vec3{double(p[0]), double(p[1]), double(p[2])}; };
  int zeros = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Whole a{any(), any(), any()}, b{any(), any(), any()}, c{any(), any(), any()};
    Whole d{};
    // Near the plane by what 2^40 leaves: a combination of the corners, and a few units beside it.
    const std::int64_t s = any() % 5, t = any() % 3;
    for (std::size_t n = 0; n < 3; ++n) d[n] = a[n] + (s * (b[n] - a[n]) + t * (c[n] - a[n])) / 4;
    d[static_cast<std::size_t>(trial % 3)] += trial % 4 - 1;
    Wide m[3][3];
    for (std::size_t n = 0; n < 3; ++n) m[0][n] = b[n] - a[n], m[1][n] = c[n] - a[n], m[2][n] = d[n] - a[n];
    const Wide value = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                       m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                       m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    const int expected = value > 0 ? 1 : value < 0 ? -1 : 0;
    ASSERT_EQ(orientation(real(a), real(b), real(c), real(d)), expected);
    ASSERT_EQ(orientation(real(b), real(a), real(c), real(d)), -expected);
    zeros += expected == 0;
  }
  EXPECT_GT(zeros, 100);
}

TEST(SelfIntersection, OrientationWithMagnitudesFarApart) {
  // Differences themselves are not doubles here.
  const Vec3 a{1e16, 1, 1e-16}, b{1, 1e16, 1e-16}, c{1e-16, 1, 1e16};
  const Vec3 tiny{0, 0, 1e-30};
  const int side = orientation(a, b, c, {1, 1, 1});
  EXPECT_NE(side, 0);
  EXPECT_EQ(orientation(b, a, c, {1, 1, 1}), -side);
  EXPECT_EQ(orientation({1e30, 0, 0}, {-1e30, 0, 0}, {0, 1, 0}, tiny), -1);
  EXPECT_EQ(orientation({1e30, 0, 0}, {-1e30, 0, 0}, {0, 1, 0}, {1e25, 3, 0}), 0);
  EXPECT_EQ(orientation(Point2{1e20, 1e20}, Point2{-1e20, -1e20}, Point2{1e-20, 0}), 1);
  EXPECT_EQ(orientation(Point2{1e20, 1e20}, Point2{-1e20, -1e20}, Point2{1e-20, 1e-20}), 0);
}

// Another way, exact for small integers: convex sets are apart when a direction keeps them apart, and for
// flat ones the normals, the products of their edges and those of normals and edges are all directions there
// are.
bool apart(const Points& a, const Points& b) {
  Points edges, directions;
  for (const Points* set : {&a, &b}) {
    for (std::size_t n = 0; n < set->size(); ++n) edges.push_back((*set)[(n + 1) % set->size()] - (*set)[n]);
  }
  for (const Vec3& e : edges)
    for (const Vec3& f : edges) directions.push_back(e.cross(f));
  const Points normals = directions;
  for (const Vec3& normal : normals)
    for (const Vec3& e : edges) directions.push_back(normal.cross(e));
  return std::any_of(directions.begin(), directions.end(), [&](const Vec3& along) {
    const auto range = [&](const Points& set) {
      std::vector<double> at;
      for (const Vec3& p : set) at.push_back(along.dot(p));
      return std::pair(*std::min_element(at.begin(), at.end()), *std::max_element(at.begin(), at.end()));
    };
    return range(a).second < range(b).first || range(b).second < range(a).first;
  });
}

bool meet_by_directions(const Corners& a, const Corners& b) {
  const auto is_of = [](const Corners& in, const Vec3& p) {
    return std::find(in.begin(), in.end(), p) != in.end();
  };
  Points only_a, only_b;
  for (const Vec3& p : a)
    if (!is_of(b, p)) only_a.push_back(p);
  for (const Vec3& p : b)
    if (!is_of(a, p)) only_b.push_back(p);
  const Points all_a(a.begin(), a.end()), all_b(b.begin(), b.end());
  switch (only_a.size()) {
    case 3:
      return !apart(all_a, all_b);
    case 2:
      return !apart(only_a, all_b) || !apart(all_a, only_b);
    case 1: {  // flat back: the same normal
      Points shared;
      for (const Vec3& p : a)
        if (is_of(b, p)) shared.push_back(p);
      const Vec3 along = shared[1] - shared[0];
      const Vec3 n = along.cross(only_a[0] - shared[0]), m = along.cross(only_b[0] - shared[0]);
      return n.cross(m).norm() == 0 && n.dot(m) > 0;
    }
    default:
      return false;
  }
}

Corners random_triangle(std::mt19937& random, int side) {
  for (;;) {
    const auto whole = [&] { return static_cast<double>(random() % static_cast<unsigned>(side)); };
    Corners corners;
    for (Vec3& p : corners) p = {whole(), whole(), whole()};
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() > 0) return corners;
  }
}

TEST(SelfIntersection, PairsAgreeWithSeparatingDirections) {
  for (const int side : {3, 5, 9}) {  // the smaller, the more often something touches
    std::mt19937 random(static_cast<unsigned>(side));
    int meet = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      const Corners a = random_triangle(random, side), b = random_triangle(random, side);
      const bool expected = meet_by_directions(a, b);
      meet += expected;
      ASSERT_EQ(triangles_intersect(a, b), expected) << "side " << side << ", trial " << trial;
    }
    EXPECT_GT(meet, 400);
  }
}

// Tets strewn about, of two labels in turn.
struct Soup {
  Mesh mesh;
  LabelImage image = test::empty_image({1, 1, 1}, {1, 1, 1}, {0, 1, 2});
};

Soup random_soup(unsigned seed, int count) {
  Soup soup;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> middle(0, 10), around(-1, 1);
  for (int n = 0; n < count; ++n) {
    const Vec3 centre{middle(random), middle(random), middle(random)};
    std::array<VertexId, 4> tet{};
    for (VertexId& v : tet) {
      v = static_cast<VertexId>(soup.mesh.points.size());
      soup.mesh.points.push_back(centre + Vec3{around(random), around(random), around(random)});
    }
    soup.mesh.tets.add(tet, 1 + n % 2);
  }
  return soup;
}

TEST(SelfIntersection, ASoupAgreesWithAllPairs) {
  const Soup soup = random_soup(3, 150);
  const MeshView view(soup.mesh, soup.image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  std::int64_t expected = 0;
  std::array<std::int64_t, 2> expected_of{};
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first;
  const auto corners = [&](std::uint32_t f) {
    const auto& n = surface.facets[f].nodes;
    return Corners{soup.mesh.points[n[0]], soup.mesh.points[n[1]], soup.mesh.points[n[2]]};
  };
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    for (std::uint32_t g = f + 1; g < surface.facets.size(); ++g) {
      if (triangles_intersect(corners(f), corners(g))) {
        first = first ? first : std::pair(f, g);
        ++expected;
        if (surface.facets[f].inside == surface.facets[g].inside) ++expected_of[surface.facets[f].inside];
      }
    }
  }
  EXPECT_GT(expected, 50);
  for (const int threads : {1, 2}) {
    set_thread_count(threads);
    const SelfIntersections found = self_intersections(view, surface);
    EXPECT_EQ(found.pairs, expected);
    EXPECT_EQ(found.per_label, (std::vector<std::int64_t>{expected_of[0], expected_of[1]}));
    EXPECT_EQ(found.first, first);
  }
  set_thread_count(0);
}

TEST(SelfIntersection, SoundMeshesHaveNone) {
  LabelImage image = test::two_boxes();
  const auto pairs = [](const Mesh& mesh, const LabelImage& of) {
    return test::judge(mesh, of, {false, false})["topology"]["self_intersections"].get<int>();
  };
  EXPECT_EQ(pairs(test::kuhn_mesh(image), image), 0);
  EXPECT_EQ(pairs(test::bcc_block(4, 1.5, 1), image), 0);
  // Planes that rounding has bent.
  image.frame.direction = Mat3::from_columns({.6, .8, 0}, {-.8, .6, 0}, {0, 0, 1});
  image.frame.origin_mm = {10.1, -3.3, .7};
  EXPECT_EQ(pairs(test::kuhn_mesh(image), image), 0);
}

TEST(SelfIntersection, IsToldWithItsPlace) {
  const LabelImage image = test::two_boxes();
  Mesh mesh = test::kuhn_mesh(image);
  const auto base = static_cast<VertexId>(mesh.points.size());
  // A thin tet of label 7 from outside into label 1's low face in x, which lies at 1.5.
  const Vec3 tip = image.frame.to_physical({1.7, 1.2, 6.1});
  for (const Vec3& p : {tip, tip - Vec3{1, 0, 0}, tip - Vec3{1, -.1, 0}, tip - Vec3{1, 0, -.1}})
    mesh.points.push_back(p);
  mesh.tets.add({base, base + 1, base + 3, base + 2}, 7);
  const nlohmann::json result = test::judge(mesh, image, {false, false});
  const nlohmann::json& topology = result["topology"];
  EXPECT_GE(topology["self_intersections"], 3);
  EXPECT_EQ(topology["per_label"][0]["self_intersections"], 0);
  EXPECT_EQ(topology["per_label"][1]["self_intersections"], 0);
  const nlohmann::json& first = topology["first_self_intersection"];
  EXPECT_EQ(first["facets"].size(), 2U);
  EXPECT_EQ(first["labels"][0], nlohmann::json::array({1, nullptr}));
  EXPECT_EQ(first["labels"][1], nlohmann::json::array({7, nullptr}));
  EXPECT_NEAR(first["at_mm"][0].get<double>(), 1.5, .2);
  bool reported = false;
  for (const nlohmann::json& fault : result["faults"]) {
    const auto text = fault.get<std::string>();
    reported = reported || text.find("pairs of surface facets that cut") != std::string::npos;
  }
  EXPECT_TRUE(reported) << result["faults"];
}

}  // namespace
}  // namespace cbc3d::metrics
