// The coarse lattice: the angles and stars of the BCC tets, and which of them are there.
#include <gtest/gtest.h>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using testing::AngleRange;
using testing::dihedral_range;
using testing::volume_of_lattice;

TEST(BccLattice, HasTheDihedralAnglesOfTheBccTet) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  const Lattice lattice = build_bcc_lattice(image, {5, 1});
  const LatticeTets tets = extract_tets(lattice);
  ASSERT_GT(tets.size(), 100U);
  const AngleRange range = dihedral_range(lattice, tets);
  EXPECT_NEAR(range.low, 60, 1e-9);
  EXPECT_NEAR(range.high, 90, 1e-9);
  EXPECT_NEAR(volume_of_lattice(lattice, tets), static_cast<double>(tets.size()) * 125 / 12,
              1e-6);  // each tet: a^3 / 12
}

TEST(BccLattice, InnerVerticesHave24TetsAnd14Edges) {
  const LabelImage image = testing::ball_image(40, 1, 18);
  const Lattice lattice = build_bcc_lattice(image, {5, 5});
  const LatticeTets tets = extract_tets(lattice);
  const VertexCells around = tets_of_vertices(tets.nodes, lattice.points.size());
  std::size_t inner = 0;
  for (std::size_t v = 0; v < lattice.points.size(); ++v) {
    if ((lattice.frame.local(lattice.points[v]) - testing::centre_of(image)).norm() < 9) {
      ++inner;
      EXPECT_EQ(around.first[v + 1] - around.first[v], 24U);
    }
  }
  EXPECT_GT(inner, 20U);
}

TEST(BccLattice, TetsWithLabelledVoxelsHaveTheWholeStarsOfTheirVertices) {
  const LabelImage image =
      testing::noise_image(40, 0.0005, 8);  // sparse: few tets hold a voxel, and far apart
  const Lattice lattice = build_bcc_lattice(image, {5, 5});
  const LatticeTets tets = extract_tets(lattice);
  const VertexCells around = tets_of_vertices(tets.nodes, lattice.points.size());
  const VoxelRaster raster(image.frame, lattice.frame);
  std::size_t labelled = 0;
  for (const auto& n : tets.nodes) {
    bool holds = false;
    raster.for_each_row(
        {lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]},
        [&](int j, int k, int begin, int end) {
          for (int i = begin; i < end; ++i) holds = holds || image.at(i, j, k) != kBackground;
        });
    for (std::size_t c = 0; holds && c < 4; ++c) {
      ++labelled;
      EXPECT_EQ(around.first[n[c] + 1] - around.first[n[c]], 24U);
    }
  }
  EXPECT_GT(labelled, 20U);
  EXPECT_LT(labelled, tets.size());
}

}  // namespace
}  // namespace cbc3d
