// Labels that change on a mesh that stays, against checks by facets alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "mesher/improve/surface/labelled_complex.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d {
namespace {

/// Random materials, of which 2 and 3 are one label.
MaterialMesh noisy_box(unsigned seed) {
  const testing::KuhnBox box(3);
  std::mt19937 random(seed);
  MaterialMesh mesh{box.points, box.tets, {}, {}, {}};
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    mesh.materials.push_back(static_cast<MaterialId>(random() % 6 < 4 ? 1 : random() % 4));
  }
  return mesh;
}

const std::vector<MaterialId> kLabelOf = {0, 1, 2, 2};

/// The facets of a label's surface at a vertex, as edges of its link, are one closed curve or none.
bool is_manifold_by_facets(const MaterialMesh& mesh, VertexId v, MaterialId material) {
  std::vector<MaterialId> labels(mesh.materials.size());
  for (std::size_t t = 0; t < labels.size(); ++t) labels[t] = kLabelOf[mesh.materials[t]];
  std::vector<testing::FaceKey> at_vertex;
  for (const testing::FaceKey& f : testing::surface_of_label(mesh.tets, labels, kLabelOf[material])) {
    if (std::count(f.begin(), f.end(), v) > 0) at_vertex.push_back(f);
  }
  std::map<VertexId, std::vector<VertexId>> link;
  for (const testing::FaceKey& f : at_vertex) {
    std::vector<VertexId> ends;
    for (const VertexId w : f) {
      if (w != v) ends.push_back(w);
    }
    link[ends[0]].push_back(ends[1]);
    link[ends[1]].push_back(ends[0]);
  }
  if (link.empty()) return true;
  std::vector<VertexId> stack = {link.begin()->first};
  std::set<VertexId> seen = {stack[0]};
  while (!stack.empty()) {
    const auto ends = link[stack.back()];
    stack.pop_back();
    if (ends.size() != 2) return false;
    for (const VertexId w : ends) {
      if (seen.insert(w).second) stack.push_back(w);
    }
  }
  return seen.size() == link.size();
}

TEST(LabelledComplex, KnowsWhereALabelsSurfaceIsNonManifold) {
  int non_manifold = 0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    MaterialMesh mesh = noisy_box(seed);
    const LabelledComplex complex(mesh, kLabelOf);
    for (VertexId v = 0; v < mesh.points.size(); ++v) {
      for (const MaterialId m : {1, 2, 3}) {
        const bool wanted = is_manifold_by_facets(mesh, v, m);
        EXPECT_EQ(complex.is_manifold_at(v, m), wanted) << seed << ' ' << v << ' ' << m;
        non_manifold += wanted ? 0 : 1;
      }
    }
  }
  EXPECT_GT(non_manifold, 20);
}

TEST(LabelledComplex, SetsAndFacetsFollowTheMaterials) {
  MaterialMesh mesh = noisy_box(4);
  LabelledComplex complex(mesh, kLabelOf);
  std::mt19937 random(5);
  for (int n = 0; n < 50; ++n) {
    const auto t = static_cast<TetId>(random() % mesh.tets.size());
    complex.relabel(t, static_cast<MaterialId>(random() % 4));
    for (const VertexId v : mesh.tets[t]) complex.renew_set(v);
  }
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  const auto sets = vertex_materials(mesh.tets, mesh.materials, neighbours, mesh.points.size());
  for (VertexId v = 0; v < sets.size(); ++v) {
    EXPECT_EQ(complex.set(v).ids, sets[v].ids);
    EXPECT_EQ(complex.set(v).size, sets[v].size);
  }
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const MaterialId own = mesh.materials[t];
      const MaterialId other = neighbours[t][n] == kNoTet ? kBackground : mesh.materials[neighbours[t][n]];
      EXPECT_EQ(complex.across(t, n), other);
      if (own == kBackground || other == kBackground) {
        EXPECT_EQ(complex.is_facet(t, n), own != kBackground);
      } else if (kLabelOf[own] == kLabelOf[other]) {
        EXPECT_FALSE(complex.is_facet(t, n));
      }
    }
  }
}

TEST(LabelledComplex, BackgroundIsTakenOutAndTheRestKeepsItsOrder) {
  MaterialMesh mesh = noisy_box(6);
  TetNodes wanted;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.materials[t] != kBackground) wanted.push_back(mesh.tets[t]);
  }
  ASSERT_LT(wanted.size(), mesh.tets.size());
  const std::size_t points = mesh.points.size();
  remove_background(mesh);
  EXPECT_EQ(mesh.tets, wanted);
  EXPECT_EQ(mesh.materials.size(), wanted.size());
  EXPECT_EQ(std::count(mesh.materials.begin(), mesh.materials.end(), kBackground), 0);
  EXPECT_EQ(mesh.points.size(), points);
}

}  // namespace
}  // namespace cbc3d
