// Our certified surface distances agree with CGAL's bounded-error Hausdorff distance on the same surfaces.
// The test is here and not among those of the metrics because CGAL is under the GPL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "metrics/surface_hausdorff.hpp"
#include "metrics/testing.hpp"

namespace {

using cbc3d::Vec3;
using cbc3d::metrics::CertifyOptions;
using cbc3d::metrics::SmoothTriangle;
using cbc3d::metrics::Triangle;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

SurfaceMesh cgal_mesh(const std::vector<Triangle>& triangles) {
  SurfaceMesh mesh;
  std::map<std::array<double, 3>, SurfaceMesh::Vertex_index> vertices;
  const auto vertex = [&](const Vec3& p) {
    const auto [at, fresh] = vertices.try_emplace({p.x, p.y, p.z});
    if (fresh) at->second = mesh.add_vertex({p.x, p.y, p.z});
    return at->second;
  };
  for (const auto& [a, b, c] : triangles) mesh.add_face(vertex(a), vertex(b), vertex(c));
  return mesh;
}

cbc3d::metrics::SearchableSurface<Triangle> our_surface(const std::vector<Triangle>& triangles) {
  std::vector<SmoothTriangle> list;
  list.reserve(triangles.size());
  for (const Triangle& t : triangles) list.push_back({t, cbc3d::kBackground, {}});
  return cbc3d::metrics::searchable_triangles(list);
}

// A sphere with bumps, whose vertices with equal positions stay equal.
std::vector<Triangle> bumpy_sphere(double radius, int n, double height, double waves, const Vec3& centre) {
  std::vector<Triangle> triangles = cbc3d::metrics::test::sphere_triangles(radius, n);
  const auto place = [&](Vec3& p) {
    // The rounding makes points equal where edges of the cube's faces meet.
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 1e9) / 1e9;
    p *= 1 + height * std::sin(waves * p.x) * std::cos(waves * p.y + p.z);
    p += centre;
  };
  for (auto& [a, b, c] : triangles) {
    place(a);
    place(b);
    place(c);
  }
  return triangles;
}

void compare(const std::vector<Triangle>& a, const std::vector<Triangle>& b) {
  constexpr double kTolerance = 1e-3;
  const auto ours =
      cbc3d::metrics::surface_distance(our_surface(a), our_surface(b), CertifyOptions{kTolerance}).value();
  const SurfaceMesh mesh_a = cgal_mesh(a), mesh_b = cgal_mesh(b);
  ASSERT_EQ(mesh_a.number_of_faces(), a.size());
  ASSERT_EQ(mesh_b.number_of_faces(), b.size());
  namespace pmp = CGAL::Polygon_mesh_processing;
  const double a_to_b =
      pmp::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(mesh_a, mesh_b, kTolerance);
  const double b_to_a =
      pmp::bounded_error_Hausdorff_distance<CGAL::Sequential_tag>(mesh_b, mesh_a, kTolerance);
  // Both are within the tolerance of the truth.
  for (const auto& [bounds, theirs] : {std::pair(ours.image_to_mesh.bounds.value(), a_to_b),
                                       std::pair(ours.mesh_to_image.bounds.value(), b_to_a)}) {
    EXPECT_LE(bounds.upper_mm - bounds.lower_mm, kTolerance + 1e-12);
    EXPECT_GE(bounds.upper_mm, theirs - kTolerance);
    EXPECT_LE(bounds.lower_mm, theirs + kTolerance);
  }
  const double two_sided =
      pmp::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(mesh_a, mesh_b, kTolerance);
  EXPECT_NEAR(ours.bounds().value().lower_mm, two_sided, 2 * kTolerance);
}

TEST(CgalHausdorff, BumpySpheresOfDifferentMeshes) {
  compare(bumpy_sphere(5, 12, .05, 1.3, {0, 0, 0}), bumpy_sphere(5.2, 7, .04, .9, {.3, -.2, .1}));
}

TEST(CgalHausdorff, CoarseAgainstFine) {
  compare(bumpy_sphere(5, 3, 0, 1, {0, 0, 0}), bumpy_sphere(5, 20, .03, 2, {0, 0, 0}));
}

TEST(CgalHausdorff, FarApart) {
  compare(bumpy_sphere(2, 6, .1, 2, {0, 0, 0}), bumpy_sphere(3, 8, .1, 1.5, {9, 4, -3}));
}

}  // namespace
