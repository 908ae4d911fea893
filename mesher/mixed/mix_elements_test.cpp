// Mixed elements: what is merged and what stays.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/mixed/mix_elements.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

using testing::block_image;
using testing::volume_of_material;

/// The paper's mesh of a block, as it comes or after the deformation.
MaterialMesh mesh_of(LabelImage image, bool mixed, int iterations) {
  MaterialMesh mesh =
      testing::paper_mesh_of_cleaned(image, {.spacing_mm = 4, .finest_spacing_mm = 4, .mixed = mixed});
  DeformOptions options;
  options.iterations = iterations;
  deform_mesh(mesh, image, options, [](int) {});
  return mesh;
}

template <std::size_t Nodes>
std::array<Vec3, Nodes> points_of(const MaterialMesh& mesh, const std::array<VertexId, Nodes>& cell) {
  std::array<Vec3, Nodes> points;
  std::transform(cell.begin(), cell.end(), points.begin(), [&](VertexId v) { return mesh.points[v]; });
  return points;
}

/// The interface and surface facets by the positions of their nodes.
std::multiset<std::array<double, 9>> surface_of(const MaterialMesh& mesh) {
  std::multiset<std::array<double, 9>> facets;
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    EXPECT_EQ(f.nodes[3], kNoVertex) << "a quadrilateral on a surface";
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh.points[f.nodes[c]];
      corners[c] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    std::array<double, 9> key{};
    for (std::size_t c = 0; c < 9; ++c) {
      key[c] = corners[c / 3][c % 3];
    }
    facets.insert(key);
  }
  return facets;
}

TEST(MixElements, KeepSurfacesVolumesAndSaveVertices) {
  const LabelImage image = block_image();
  const MaterialMesh tets = mesh_of(image, false, 0);
  const MaterialMesh mixed = mesh_of(image, true, 0);
  ASSERT_GT(mixed.hexes.size(), 100U);
  EXPECT_GT(mixed.pyramids.size(), 100U);
  EXPECT_LT(static_cast<double>(mixed.points.size()), 0.8 * static_cast<double>(tets.points.size()));
  EXPECT_EQ(surface_of(mixed), surface_of(tets));
  for (const MaterialId m : {1, 2}) {
    EXPECT_NEAR(volume_of_material(mixed, m), volume_of_material(tets, m),
                1e-9 * volume_of_material(tets, m));
  }
}

TEST(MixElements, MakeCubesAndTheLatticesPyramids) {
  const MaterialMesh mixed = mesh_of(block_image(), true, 0);
  for (const auto& cell : mixed.hexes.nodes) {
    EXPECT_NEAR(scaled_jacobian_hex(points_of(mixed, cell)), 1, 1e-12);
  }
  for (const auto& cell : mixed.pyramids.nodes) {
    EXPECT_NEAR(scaled_jacobian_pyramid(points_of(mixed, cell)), 1, 1e-12);
  }
}

TEST(MixElements, EveryInnerFacetHasTwoCells) {
  // A facet that a hex shows as a quadrilateral and a tet as triangles would come out as a surface within a
  // material.
  for (const int iterations : {0, 5}) {
    const MaterialMesh mixed = mesh_of(block_image(), true, iterations);
    for (const InterfaceFacet& f : interface_facets(mixed, cells_of_vertices(mixed))) {
      EXPECT_NE(f.lower, f.higher);
      EXPECT_EQ(f.nodes[3], kNoVertex);
    }
  }
}

TEST(MixElements, MergeADeformedMeshToo) {
  const LabelImage image = block_image();
  MaterialMesh mesh = mesh_of(image, false, 3);
  const auto surface = surface_of(mesh);
  const MixReport strict = [&] {
    MaterialMesh copy = mesh;
    return mix_elements(copy, {});
  }();
  const MixReport report = mix_elements(mesh, {false, 0.4});
  EXPECT_GT(report.hexes, 0U);
  EXPECT_GT(report.hexes, strict.hexes) << "deformed tets are not red any more";
  EXPECT_EQ(surface_of(mesh), surface);
  for (const auto& cell : mesh.hexes.nodes) {
    EXPECT_GE(scaled_jacobian_hex(points_of(mesh, cell)), 0.4);
  }
}

TEST(MixElements, FindNothingInATetMeshWithoutUniformStars) {
  MaterialMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.materials = {1};
  const MixReport report = mix_elements(mesh, {});
  EXPECT_EQ(report.hexes + report.pyramids + report.tets_merged, 0U);
  EXPECT_EQ(mesh.points.size(), 4U);
}

}  // namespace
}  // namespace cbc3d
