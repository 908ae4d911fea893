// The core of hexahedra: which stars are chosen, and what is merged after the mesh around them has changed.
#include "mesher/mixed/hex_core.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/interface_facets.hpp"
#include "mesher/topology/material_set.hpp"

namespace cbc3d {
namespace {

constexpr double kEdge = 1.5;
constexpr double kBand = 2.5 * kEdge;  // two and a half layers

/// The lattice mesh of a block of two materials: cubes of 4 mm inside.
MaterialMesh lattice_mesh() {
  LabelImage image = testing::block_image();
  return testing::paper_mesh_of_cleaned(image, {.spacing_mm = 4, .finest_spacing_mm = 4});
}

std::vector<Vec3> interface_points(const MaterialMesh& mesh) {
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  std::vector<Vec3> points;
  for (std::size_t v = 0; v < sets.size(); ++v) {
    if (sets[v].size > 1) {
      points.push_back(mesh.points[v]);
    }
  }
  return points;
}

std::size_t fixed_count(const HexCore& core) {
  return static_cast<std::size_t>(std::count(core.fixed.begin(), core.fixed.end(), 1));
}

TEST(HexCore, StarsAreDeepAndWithoutConflict) {
  const MaterialMesh mesh = lattice_mesh();
  const HexCore core = choose_hex_core(mesh, {.surface_edge_mm = kEdge, .longest_mm = 4}, {});
  ASSERT_GT(core.centres.size(), 100U);
  ASSERT_EQ(core.fixed.size(), mesh.points.size());
  const std::vector<Vec3> interfaces = interface_points(mesh);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    for (std::size_t i = 0; core.fixed[v] != 0 && i < interfaces.size(); ++i) {
      ASSERT_GE((mesh.points[v] - interfaces[i]).norm(), kBand - 1e-9);
    }
  }
  for (std::size_t c = 0; c < core.centres.size(); ++c) {
    for (std::size_t d = 0; d < c; ++d) {  // centres of one colour are a cube's edge apart or more
      ASSERT_GE((core.centres[c] - core.centres[d]).norm(), 4 - 1e-9);
    }
  }
}

TEST(HexCore, StarsOfSmallSpacingAreLeftToTheDecimation) {
  const MaterialMesh mesh = lattice_mesh();
  const auto centres = [&](const HexCoreOptions& options) {
    return choose_hex_core(mesh, options, {}).centres.size();
  };
  EXPECT_GT(centres({.surface_edge_mm = kEdge, .longest_mm = 5.8}), 100U);
  EXPECT_EQ(centres({.surface_edge_mm = kEdge, .longest_mm = 6}), 0U);  // .68 * 6 > 4
  EXPECT_GT(centres({.surface_edge_mm = kEdge, .gradation = 0}), 100U);
  EXPECT_EQ(centres({.surface_edge_mm = kEdge, .gradation = -1}), 0U);
  const std::vector<double> first_alone = {9, 4, 9};
  const HexCore core =
      choose_hex_core(mesh, {.surface_edge_mm = kEdge, .longest_of_material_mm = first_alone}, {});
  MaterialMesh merged = mesh;
  merge_hex_core(merged, core, {});
  EXPECT_GT(merged.hexes.size(), 10U);
  EXPECT_EQ(std::count(merged.hexes.materials.begin(), merged.hexes.materials.end(), 2), 0);
}

TEST(HexCore, MergesInAMeshOfOtherOrderAndKeepsItsVolumes) {
  MaterialMesh mesh = lattice_mesh();
  const HexCore core = choose_hex_core(mesh, {.surface_edge_mm = kEdge, .longest_mm = 4}, {});
  const std::array volumes = {testing::volume_of_material(mesh, 1), testing::volume_of_material(mesh, 2)};
  const std::size_t cells = mesh.cell_count();
  std::reverse(mesh.tets.begin(), mesh.tets.end());
  std::reverse(mesh.materials.begin(), mesh.materials.end());
  order_for_locality(mesh);
  const MixReport report = merge_hex_core(mesh, core, {});
  EXPECT_EQ(report.hexes, core.centres.size());
  EXPECT_EQ(mesh.hexes.size(), report.hexes);
  EXPECT_EQ(report.vertices_before - report.vertices_after, report.hexes);
  EXPECT_EQ(cells - mesh.cell_count(), core.cells_saved);
  for (const MaterialId m : {1, 2}) {
    EXPECT_NEAR(testing::volume_of_material(mesh, m), volumes[m - 1U], 1e-9 * volumes[m - 1U]);
  }
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    EXPECT_NE(f.lower, f.higher);
    EXPECT_EQ(f.nodes[3], kNoVertex);
  }
}

TEST(HexCore, AStarThatHasMovedStaysTets) {
  MaterialMesh mesh = lattice_mesh();
  const HexCore core = choose_hex_core(mesh, {.surface_edge_mm = kEdge, .longest_mm = 4}, {});
  ASSERT_GT(core.centres.size(), 0U);
  const auto centre = std::find(mesh.points.begin(), mesh.points.end(), core.centres[0]);
  ASSERT_NE(centre, mesh.points.end());
  const auto touched = std::count_if(core.centres.begin(), core.centres.end(), [&](const Vec3& c) {
    return (c - core.centres[0]).norm() < 4 + 1e-9;  // its own star, and those it is an axis neighbour of
  });
  centre->x += 0.1;
  EXPECT_EQ(merge_hex_core(mesh, core, {}).hexes, core.centres.size() - static_cast<std::size_t>(touched));
}

TEST(HexCore, AThinMeshHasNone) {
  const LabelImage thin = testing::make_image({40, 40, 12}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.x > 4 && p.x < 35 && p.y > 4 && p.y < 35 && p.z > 4 && p.z < 7 ? 1 : 0;
  });
  LabelImage image = thin;
  const MaterialMesh mesh = testing::paper_mesh_of_cleaned(image, {.spacing_mm = 4, .finest_spacing_mm = 2});
  const HexCore core = choose_hex_core(mesh, {.surface_edge_mm = 2, .longest_mm = 4}, {});
  EXPECT_TRUE(core.centres.empty());
  EXPECT_EQ(core.cells_saved, 0U);
  EXPECT_EQ(fixed_count(core), 0U);
}

}  // namespace
}  // namespace cbc3d
