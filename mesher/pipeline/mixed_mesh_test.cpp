// Mixed elements under the preset "quality": hexes inside, the improved surface of the mesh of tets, nothing
// lost.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

constexpr int kSize = 68;
constexpr double kRadius = 30;

/// A ball that has room for cubes of 10 mm, which the lattice has inside.
LabelImage large_ball(double core_mm = 0) {
  return testing::ball_image(kSize, 1, kRadius, core_mm);
}

Mesh mesh_of(const LabelImage& image, bool mixed, MeshImageReport& report,
             const std::string& preset = "quality") {
  MeshImageOptions options = preset_options(preset, image.frame);
  options.mixed = mixed;
  Progress quiet;
  return mesh_image(image, options, quiet, report);
}

Mesh mesh_of(const LabelImage& image, bool mixed) {
  MeshImageReport report;
  return mesh_of(image, mixed, report);
}

/// The ball's two meshes, which several tests look at.
struct BallMeshes {
  LabelImage image = large_ball();
  MeshImageReport report;
  Mesh mixed = mesh_of(image, true, report);
  Mesh tets = mesh_of(image, false);
};
const BallMeshes& ball_meshes() {
  static const BallMeshes meshes;
  return meshes;
}

template <std::size_t Nodes>
std::array<Vec3, Nodes> points_of(const Mesh& mesh, const std::array<VertexId, Nodes>& cell) {
  std::array<Vec3, Nodes> points;
  std::transform(cell.begin(), cell.end(), points.begin(), [&](VertexId v) { return mesh.points[v]; });
  return points;
}

bool same_mesh(const Mesh& a, const Mesh& b) {
  return a.points == b.points && a.tets.nodes == b.tets.nodes && a.tets.labels == b.tets.labels &&
         a.pyramids.nodes == b.pyramids.nodes && a.hexes.nodes == b.hexes.nodes &&
         a.hexes.labels == b.hexes.labels;
}

/// Interfaces and surfaces are triangles with a label of each kind on their sides: no face inside a label is
/// a quadrilateral for one of its cells and two triangles for the other.
void expect_conforming(const MaterialMesh& mesh) {
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    ASSERT_NE(f.lower, f.higher);
    ASSERT_EQ(f.nodes[3], kNoVertex);
  }
}

/// Distances of the outer surface's vertices from the sphere: the largest and the mean.
std::array<double, 2> errors_of_ball(const MaterialMesh& mesh, const Vec3& centre) {
  std::array<double, 2> error{};
  std::size_t count = 0;
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    for (std::size_t c = 0; f.lower == kBackground && c < 3; ++c) {
      const double off = std::abs((mesh.points[f.nodes[c]] - centre).norm() - kRadius);
      error[0] = std::max(error[0], off);
      error[1] += off;
      ++count;
    }
  }
  error[1] /= static_cast<double>(count);
  return error;
}

TEST(MixedQuality, ABallHasHexesInsideAndTheSurfaceOfItsTets) {
  const auto& [image, report, mixed, tets] = ball_meshes();
  EXPECT_GE(mixed.hexes.size(), 8U);
  EXPECT_EQ(report.mix.hexes, mixed.hexes.size());
  EXPECT_EQ(report.mix.pyramids, mixed.pyramids.size());
  EXPECT_GE(report.improve.min_dihedral_after_deg, 20);
  EXPECT_GE(testing::smallest_dihedral_deg(mixed), 20);
  EXPECT_LT(mixed.points.size(), tets.points.size());
  EXPECT_EQ(tets.hexes.size() + tets.pyramids.size(), 0U);
  EXPECT_TRUE(report.topology_differences.empty());

  const MaterialMesh local = to_material_mesh(mixed, image);
  const MaterialMesh local_tets = to_material_mesh(tets, image);
  expect_conforming(local);
  const double voxels = static_cast<double>(image.voxels_per_material()[1]);
  EXPECT_NEAR(testing::volume_of_material(local, 1), voxels, 0.002 * voxels);
  EXPECT_NEAR(testing::volume_of_material(local, 1), testing::volume_of_material(local_tets, 1),
              0.002 * voxels);
  const auto with = errors_of_ball(local, testing::centre_of(image));
  const auto without = errors_of_ball(local_tets, testing::centre_of(image));
  EXPECT_LT(with[0], 0.9);
  EXPECT_LT(with[1], 1.1 * without[1]);
}

TEST(MixedQuality, HexesAndPyramidsAreTheLattices) {
  const Mesh& mesh = ball_meshes().mixed;
  ASSERT_GT(mesh.hexes.size(), 0U);
  ASSERT_GT(mesh.pyramids.size(), 0U);
  for (const auto& hex : mesh.hexes.nodes) {
    EXPECT_NEAR(scaled_jacobian_hex(points_of(mesh, hex)), 1, 1e-6);
  }
  for (const auto& pyramid : mesh.pyramids.nodes) {
    EXPECT_NEAR(scaled_jacobian_pyramid(points_of(mesh, pyramid)), 1, 1e-6);
  }
}

TEST(MixedQuality, TheCoarseInsideHasAFifthFewerVertices) {
  const LabelImage& image = ball_meshes().image;
  const auto inner_vertices = [&](const Mesh& mesh) {
    return std::count_if(mesh.points.begin(), mesh.points.end(), [&](const Vec3& p) {
      return (image.frame.to_physical(testing::centre_of(image)) - p).norm() < kRadius - 6;
    });
  };
  EXPECT_LT(static_cast<double>(inner_vertices(ball_meshes().mixed)),
            0.8 * static_cast<double>(inner_vertices(ball_meshes().tets)));
}

TEST(MixedQuality, SameBytesAtOneAndTwoThreads) {
  const LabelImage image = large_ball(12);
  omp_set_num_threads(1);
  const Mesh one = mesh_of(image, true);
  omp_set_num_threads(2);
  EXPECT_TRUE(same_mesh(one, mesh_of(image, true)));
}

TEST(MixedQuality, AThinImageHasNoHexesAndItIsSaid) {
  const LabelImage image = testing::make_image({40, 40, 12}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.x > 4 && p.x < 35 && p.y > 4 && p.y < 35 && p.z > 4 && p.z < 7 ? 1 : 0;
  });
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, true, report);
  EXPECT_EQ(mesh.hexes.size() + mesh.pyramids.size(), 0U);
  EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning) {
    return warning.find("no hexahedra") != std::string::npos;
  }));
  EXPECT_TRUE(same_mesh(mesh, mesh_of(image, false)));
}

TEST(MixedQuality, ANumberOfElementsCountsAllKinds) {
  const LabelImage image = large_ball();
  MeshImageOptions options = preset_options("quality", image.frame);
  options.mixed = true;
  options.elements = 6000;
  Progress quiet;
  MeshImageReport report;
  const Mesh mesh = mesh_image(image, options, quiet, report);
  EXPECT_GT(mesh.hexes.size(), 0U);
  EXPECT_NEAR(static_cast<double>(mesh.tets.size() + mesh.pyramids.size() + mesh.hexes.size()), 6000, 600);
}

}  // namespace
}  // namespace cbc3d
