#include "baselines/ld/merge_mesh.hpp"

#include <algorithm>

#include "baselines/ld/testing_lattice_mesh.hpp"

namespace cbc3d::baselines::ld {
namespace {

// An octahedron around a vertex: eight tets.
LatticeMesh octahedron() {
  LatticeMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {-2, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 2}, {0, 0, -2}};
  mesh.states.resize(mesh.points.size());
  for (VertexId x = 1; x <= 2; ++x) {
    for (VertexId y = 3; y <= 4; ++y) {
      for (VertexId z = 5; z <= 6; ++z) {
        std::array<VertexId, 4> tet{0, x, y, z};
        if (testing::orientation_of(mesh, tet) < 0) std::swap(tet[1], tet[2]);
        mesh.tets.push_back(tet);
        mesh.materials.push_back(1);
      }
    }
  }
  return mesh;
}

std::vector<TetId> star_of(MergeMesh& mesh, VertexId v) {
  std::vector<TetId> star;
  mesh.for_star(v, [&](TetId t, std::uint32_t node) {
    EXPECT_EQ(mesh.nodes(t)[node], v);
    star.push_back(t);
  });
  std::sort(star.begin(), star.end());
  return star;
}

TEST(MergeMesh, AMergeTakesTheTetsOfTheEdgeAndKeepsTheOthers) {
  MergeMesh mesh(octahedron());
  EXPECT_EQ(star_of(mesh, 0).size(), 8U);
  EXPECT_EQ(star_of(mesh, 1).size(), 4U);
  mesh.merge(0, 1);
  EXPECT_FALSE(mesh.is_alive(0));
  EXPECT_EQ(star_of(mesh, 1).size(), 4U);
  EXPECT_EQ(star_of(mesh, 2).size(), 4U);
  EXPECT_EQ(star_of(mesh, 3).size(), 2U);
  const LatticeMesh left = mesh.release();
  EXPECT_EQ(left.points.size(), 6U);
  EXPECT_EQ(left.tets.size(), 4U);
  EXPECT_EQ(testing::volumes_of(left), testing::volumes_of(octahedron()));
}

TEST(MergeMesh, WithoutMergesNothingChanges) {
  const LatticeMesh before = octahedron();
  const LatticeMesh after = MergeMesh(before).release();
  EXPECT_EQ(after.points, before.points);
  EXPECT_EQ(after.tets, before.tets);
}

}  // namespace
}  // namespace cbc3d::baselines::ld
