// Facets on interfaces, against a table of all facets.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/testing/mixed_cubes.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

using Key = std::set<VertexId>;

/// Every facet's nodes with the cells that have it.
std::map<Key, std::vector<CellId>> cells_of_facets(const MaterialMesh& mesh) {
  const std::map<std::size_t, std::vector<std::vector<std::size_t>>> kinds = {
      {4, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}},
      {5, {{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
      {8, {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};
  std::map<Key, std::vector<CellId>> cells;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.nodes_of(c);
    for (const auto& facet : kinds.at(nodes.size())) {
      Key key;
      for (const std::size_t n : facet) key.insert(nodes[n]);
      cells[key].push_back(c);
    }
  }
  return cells;
}

template <typename Nodes>
Vec3 mean_of(const MaterialMesh& mesh, const Nodes& nodes) {
  Vec3 sum;
  for (const VertexId v : nodes) sum += mesh.points[v];
  return sum / static_cast<double>(nodes.size());
}

TEST(InterfaceFacets, AreThoseBetweenTwoMaterialsAndLookToTheHigher) {
  const MaterialMesh mesh = testing::mixed_cubes(4);
  ASSERT_GT(mesh.hexes.size() * mesh.pyramids.size() * mesh.tets.size(), 0U);
  const auto cells = cells_of_facets(mesh);
  std::set<Key> wanted;
  for (const auto& [key, of] : cells) {
    ASSERT_LE(of.size(), 2U);  // the mesh is conforming
    if (of.size() == 1 || mesh.material_of(of[0]) != mesh.material_of(of[1])) wanted.insert(key);
  }
  std::set<Key> found;
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    const std::vector<VertexId> nodes(f.nodes.begin(), f.nodes.end() - (f.nodes[3] == kNoVertex ? 1 : 0));
    const Key key(nodes.begin(), nodes.end());
    EXPECT_TRUE(found.insert(key).second) << "a facet comes twice";
    const auto& of = cells.at(key);
    const auto higher = std::max_element(
        of.begin(), of.end(), [&](CellId a, CellId b) { return mesh.material_of(a) < mesh.material_of(b); });
    EXPECT_EQ(f.higher, mesh.material_of(*higher));
    EXPECT_EQ(f.lower, of.size() == 1 ? kBackground : 1);
    const Vec3 normal =
        (mesh.points[nodes[1]] - mesh.points[nodes[0]]).cross(mesh.points[nodes[2]] - mesh.points[nodes[0]]);
    EXPECT_GT(normal.dot(mean_of(mesh, mesh.nodes_of(*higher)) - mean_of(mesh, nodes)), 0);
  }
  EXPECT_EQ(found, wanted);
}

TEST(InterfaceFacets, AFacetOfThreeCellsIsRefused) {
  MaterialMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}};
  mesh.materials = {1, 1, 1};
  EXPECT_THROW(interface_facets(mesh, cells_of_vertices(mesh)), JobError);
}

}  // namespace
}  // namespace cbc3d
