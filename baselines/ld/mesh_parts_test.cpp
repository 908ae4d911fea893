#include "baselines/ld/mesh_parts.hpp"

#include <set>

#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::ld {
namespace {

std::multiset<std::set<LatticePoint>> tets_by_place(const LatticeMesh& mesh) {
  std::multiset<std::set<LatticePoint>> tets;
  for (const auto& n : mesh.tets) {
    tets.insert({mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]});
  }
  return tets;
}

std::multiset<std::set<LatticePoint>> facets_of_pieces(const LatticeMesh& mesh) {
  std::multiset<std::set<LatticePoint>> facets;
  for (const BoundaryPiece& p : mesh.pieces) {
    facets.insert({mesh.points[p.facet[0]], mesh.points[p.facet[1]], mesh.points[p.facet[2]]});
  }
  return facets;
}

TEST(MeshParts, PutTogetherAreTheMeshThatWasCut) {
  const LabelImage image = cbc3d::testing::touching_balls();
  const CellGrid grid(image, {.margin = 1, .block = 8});
  const LatticeMesh whole = testing::whole_initial_mesh(grid, {.with_background = true, .with_pieces = true});
  const MeshParts cut(whole, 8, 4);
  ASSERT_GT(cut.size(), 8U);
  std::vector<LatticeMesh> parts;
  std::size_t vertices = 0;
  for (std::size_t n = 0; n < cut.size(); ++n) {
    parts.push_back(cut.part(n));
    vertices += parts.back().points.size();
  }
  EXPECT_GT(vertices, whole.points.size());
  EXPECT_GT(cut.loose_pieces().size(), 0U);
  const LatticeMesh again = joined(parts, cut.loose_pieces());
  EXPECT_EQ(again.points.size(), whole.points.size());
  EXPECT_EQ(tets_by_place(again), tets_by_place(whole));
  EXPECT_EQ(facets_of_pieces(again), facets_of_pieces(whole));
}

TEST(MeshParts, OnlyVerticesOfOnePartAreFreeInIt) {
  const LabelImage image = cbc3d::testing::touching_balls();
  const CellGrid grid(image, {.block = 8});
  const LatticeMesh whole = testing::whole_initial_mesh(grid);
  const MeshParts cut(whole, 8, 4);
  std::map<LatticePoint, int> parts_with;
  std::set<LatticePoint> frozen;
  for (std::size_t n = 0; n < cut.size(); ++n) {
    const LatticeMesh part = cut.part(n);
    for (std::size_t v = 0; v < part.points.size(); ++v) {
      ++parts_with[part.points[v]];
      if (part.states[v].is_frozen) frozen.insert(part.points[v]);
    }
  }
  for (const auto& [place, count] : parts_with) EXPECT_EQ(frozen.contains(place), count > 1);
}

}  // namespace
}  // namespace cbc3d::baselines::ld
