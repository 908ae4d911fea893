#include "metrics/surface_samples.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The integral of x^2 over the sampled surface.
double integral(const SampledSurface& samples) {
  double total = 0;
  for (std::size_t n = 0; n < samples.points.size(); ++n) {
    total += samples.weights_mm2[n] * samples.points[n].x * samples.points[n].x;
  }
  return total;
}

TEST(SurfaceSamples, OfFacetsIntegrateQuadraticsExactly) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  const LabelImage image = test::empty_image({3, 3, 3}, {1, 1, 1}, {0, 1});
  const MeshView view(mesh, image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  const SampledSurface samples = sample_facets(surface, surface.facets_of[0], mesh.points);
  EXPECT_EQ(samples.pieces.size(), 4U);
  EXPECT_EQ(samples.points.size(), 4U + 4 + 6);  // centroids, vertices, midpoints, each once
  const double area = 1.5 + std::sqrt(3.0) / 2;
  EXPECT_NEAR(samples.area_mm2, area, 1e-14);
  EXPECT_NEAR(sum(samples.weights_mm2), area, 1e-14);
  // Over a right triangle of legs 1, one of them along x: 1/12; over the slanted one the same times its area
  // over 1/2.
  EXPECT_NEAR(integral(samples), 2.0 / 12 + std::sqrt(3.0) / 12, 1e-14);
}

TEST(SurfaceSamples, OfVoxelFacesAndTrianglesAreTheirCentres) {
  const LabelImage image = test::two_boxes();
  const SampledSurface faces = sample_voxel_faces({{{4, 3, 2}, 0, 1, 2}}, image.frame);
  ASSERT_EQ(faces.points.size(), 1U);
  EXPECT_EQ(faces.points[0].x, centre_of({{4, 3, 2}, 0, 1, 2}, image.frame).x);
  EXPECT_NEAR(faces.area_mm2, 0.5 * 2.0, 1e-15);  // of the voxels' sides along y and z
  SmoothTriangle triangle{};
  triangle.triangle = {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 3, 0}};
  const SampledSurface samples = sample_triangles({triangle});
  ASSERT_EQ(samples.points.size(), 1U);
  EXPECT_NEAR(samples.points[0].x, 1, 1e-15);
  EXPECT_NEAR(samples.weights_mm2[0], 4.5, 1e-15);
}

}  // namespace
}  // namespace cbc3d::metrics
