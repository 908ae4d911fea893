#include "baselines/cleaver/background_lattice.hpp"

#include <gtest/gtest.h>

#include "baselines/cleaver/testing_lattice.hpp"
#include "baselines/cleaver/tet_angles.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(BackgroundLattice, TheUniformOneHasTwelveTetsForACellAndAnglesOf60And90Degrees) {
  const Lattice lattice = testing::uniform_lattice(6);
  // Each face between two cells has four.
  EXPECT_EQ(lattice.tets.size(), 4U * 3 * 6 * 6 * 5);
  for (const auto& n : lattice.tets) {
    const auto& p = lattice.points;
    ASSERT_TRUE(has_angles_within({p[n[0]], p[n[1]], p[n[2]], p[n[3]]}, 59.99, 90.01));
  }
  EXPECT_EQ(cbc3d::testing::crowded_faces(lattice.tets), 0U);
}

// Inside, a conforming lattice has no face with one tet.
TEST(BackgroundLattice, GradedOnesConform) {
  std::mt19937 random(3);
  for (int round = 0; round < 4; ++round) {
    const Lattice lattice = testing::graded_lattice(24, random);
    std::map<cbc3d::testing::FaceKey, int> faces;
    for (const auto& nodes : lattice.tets) {
      for (std::size_t n = 0; n < 4; ++n) ++faces[cbc3d::testing::face_key(nodes, n)];
      const auto& p = lattice.points;
      ASSERT_TRUE(has_angles_within({p[nodes[0]], p[nodes[1]], p[nodes[2]], p[nodes[3]]}, 44.99, 120.01));
    }
    for (const auto& [face, count] : faces) {
      const Vec3 middle = (lattice.points[face[0]] + lattice.points[face[1]] + lattice.points[face[2]]) / 3;
      const bool inside = middle.min_coeff() > 4.1 && middle.max_coeff() < 19.9;
      ASSERT_LE(count, 2);
      if (inside) {
        ASSERT_EQ(count, 2) << middle.x << " " << middle.y << " " << middle.z;
      }
    }
  }
}

TEST(BackgroundLattice, KeepsTheWantedTetsAndTheirVertices) {
  Lattice lattice = testing::uniform_lattice(3);
  const Lattice whole = lattice;
  std::vector<char> keep(lattice.tets.size(), 0);
  keep[5] = 1;
  const std::vector<VertexId> former = keep_tets(lattice, keep);
  ASSERT_EQ(lattice.tets.size(), 1U);
  ASSERT_EQ(lattice.points.size(), 4U);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(former[lattice.tets[0][n]], whole.tets[5][n]);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver
