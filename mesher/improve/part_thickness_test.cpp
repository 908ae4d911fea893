// Thickness of layers, and of parts of an image, at the vertices of their surfaces.
#include "mesher/improve/part_thickness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/mesh_domain.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/lattice/testing_lattice_mesh.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

using testing::two_layers;

TEST(PartThickness, TheThinnerOfTwoLayersCounts) {
  const MaterialMesh mesh = two_layers(6, 2);
  const MeshDomain domain(mesh, {0, 1, 2});
  const std::vector<double> thickness = thickness_at_vertices(mesh, domain, 5);
  const double step_mm = 0.25 * std::cbrt(domain.cell_mm3());
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const bool in_middle = p.x > 0 && p.x < 6 && p.y > 0 && p.y < 6;
    if (in_middle && (p.z == 0 || p.z == 2)) {
      EXPECT_NEAR(thickness[v], 2, 2 * step_mm) << p.z;
    } else if (in_middle && p.z == 6) {
      EXPECT_NEAR(thickness[v], 4, 2 * step_mm);
    } else if (in_middle) {
      EXPECT_EQ(thickness[v], std::numeric_limits<double>::infinity()) << "inside";
    }
  }
}

TEST(PartThickness, WhatIsAsThickAsTheLimitHasNone) {
  const MaterialMesh mesh = two_layers(6, 2);
  const MeshDomain domain(mesh, {0, 1, 2});
  const std::vector<double> thickness = thickness_at_vertices(mesh, domain, 1.5);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const bool in_middle = p.x > 1 && p.x < 5 && p.y > 1 && p.y < 5;
    EXPECT_TRUE(!in_middle || std::isinf(thickness[v]));
  }
}

/// A slab of so many voxels, thick along z, whose voxels are half as high as wide.
LabelImage slab(int layers) {
  return testing::make_image({16, 16, 20}, {1, 1, 0.5}, 1, [layers](const Vec3& p) {
    const auto within = [](double x, double low, double high) { return x >= low && x < high; };
    return within(p.x, 2, 14) && within(p.y, 2, 14) && within(p.z, 3, 3 + 0.5 * layers) ? 1 : 0;
  });
}

TEST(PartThickness, IsThatOfTheImagesParts) {
  for (const int layers : {1, 2, 4}) {
    const LabelImage image = slab(layers);
    const MaterialMesh mesh = testing::lattice_mesh(image);
    const ImageDomain domain(image);
    const std::vector<double> thickness = thickness_at_vertices(mesh, domain, 4);
    double sum = 0;
    int count = 0;
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      const Vec3& p = mesh.points[v];
      const bool in_middle = p.x > 4 && p.x < 11 && p.y > 4 && p.y < 11;
      if (in_middle && !std::isinf(thickness[v])) {
        sum += thickness[v];
        ++count;
      }
    }
    ASSERT_GT(count, 10);
    EXPECT_NEAR(sum / count, 0.5 * layers, 0.3) << layers;
    testing::at_thread_counts([&] { EXPECT_EQ(thickness_at_vertices(mesh, domain, 4), thickness); });
  }
}

}  // namespace
}  // namespace cbc3d
