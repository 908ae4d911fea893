// Meshes of materials: their files' labels, vertices and order.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/mixed_cubes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {
namespace {

TEST(MaterialMesh, ComesFromAFileWithTheImagesMaterials) {
  LabelImage image =
      testing::make_image({6, 6, 6}, {1, 1, 1}, 2, [](const Vec3& p) { return p.x < 3 ? 1 : 2; });
  image.labels = {0, 40, 70};
  const MaterialMesh mesh = testing::mixed_cubes(4);
  for (const bool flipped : {false, true}) {
    image.frame = testing::oblique(ImageFrame{{6, 6, 6}}, flipped);
    const MaterialMesh back = to_material_mesh(to_physical_mesh(mesh, image), image);
    ASSERT_EQ(back.cell_count(), mesh.cell_count());
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      EXPECT_EQ(back.material_of(c), mesh.material_of(c));
      EXPECT_GT(testing::volume_of_cell(back, c), 0);
    }
  }
  Mesh stranger;
  stranger.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  stranger.tets.add({0, 1, 2, 3}, 9);
  EXPECT_THROW(to_material_mesh(stranger, image), InputError);
  Mesh wedge;
  wedge.points.resize(6);
  wedge.wedges.add({0, 1, 2, 3, 4, 5}, 1);
  EXPECT_THROW(to_material_mesh(wedge, image), InputError);
}

TEST(MaterialMesh, CellsOfAVertexAreThoseThatHaveIt) {
  const MaterialMesh mesh = testing::mixed_cubes(4);
  std::vector<std::vector<CellId>> wanted(mesh.points.size());
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    for (const VertexId v : mesh.nodes_of(c)) wanted[v].push_back(c);
  }
  testing::at_thread_counts([&] {
    const VertexCells around = cells_of_vertices(mesh);
    for (VertexId v = 0; v < wanted.size(); ++v) {
      EXPECT_EQ(std::vector<CellId>(around.of(v).begin(), around.of(v).end()), wanted[v]);
    }
  });
}

/// Every tet by its material and the places of its nodes.
std::multiset<std::vector<double>> tets_by_place(const MaterialMesh& mesh) {
  std::multiset<std::vector<double>> all;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::vector<double> one = {static_cast<double>(mesh.materials[t])};
    for (const VertexId v : mesh.tets[t]) {
      one.insert(one.end(), {mesh.points[v].x, mesh.points[v].y, mesh.points[v].z});
    }
    all.insert(one);
  }
  return all;
}

TEST(MaterialMesh, BackgroundGoesWithTheVerticesThatItAloneHas) {
  const testing::KuhnBox box(3);
  std::vector<MaterialId> materials(box.tets.size());
  for (std::size_t t = 0; t < box.tets.size(); ++t) materials[t] = box.centroid(t).x < 1 ? 0 : 1;
  const MaterialMesh kept = discard_background(box.points, box.tets, materials);
  EXPECT_EQ(kept.tets.size(), 6U * 18);
  EXPECT_EQ(kept.points.size(), 3U * 16);
  std::vector<Vec3> wanted;
  std::copy_if(box.points.begin(), box.points.end(), std::back_inserter(wanted),
               [](const Vec3& p) { return p.x >= 1; });
  EXPECT_EQ(kept.points, wanted);  // in their order
  EXPECT_EQ(std::count(kept.materials.begin(), kept.materials.end(), 1), 6 * 18);
}

TEST(MaterialMesh, AnotherOrderIsTheSameMesh) {
  const testing::KuhnBox box(6);
  MaterialMesh mesh{box.points, box.tets, {}, {}, {}};
  for (std::size_t t = 0; t < box.tets.size(); ++t)
    mesh.materials.push_back(static_cast<MaterialId>(1 + t % 3));
  MaterialMesh ordered = mesh;
  order_for_locality(ordered);
  EXPECT_EQ(tets_by_place(ordered), tets_by_place(mesh));
  const auto first = [](const auto& tet) { return *std::min_element(tet.begin(), tet.end()); };
  EXPECT_TRUE(std::is_sorted(ordered.tets.begin(), ordered.tets.end(),
                             [&](const auto& a, const auto& b) { return first(a) < first(b); }));
  const auto way = [](const MaterialMesh& of) {
    double sum = 0;
    for (std::size_t v = 1; v < of.points.size(); ++v) sum += (of.points[v] - of.points[v - 1]).norm();
    return sum;
  };
  EXPECT_NE(ordered.points, mesh.points);
  EXPECT_LT(way(ordered), 2 * way(mesh));
}

}  // namespace
}  // namespace cbc3d
