// Parts of voxels in tets of other materials: by the place of each part.
#include "mesher/lattice/part_raster.hpp"

#include <gtest/gtest.h>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

TEST(PartRaster, FindsThePartsOnTheWrongSide) {
  const LabelImage image =
      testing::make_image({8, 8, 8}, {1, 1, 1}, 1, [](const Vec3& p) { return p.x < 3.5 ? 1 : 0; });
  const Lattice lattice = build_bcc_lattice(image, {1, 0.5});
  const LatticeTets tets = extract_tets(lattice);
  const PartRaster parts(image, lattice.frame);
  // The mesh calls everything 1: what is misplaced is the background, all of its parts.
  CandidateMesh mesh{.tets = tets, .materials = std::vector<MaterialId>(tets.size(), 1), .neighbours = {}};
  const auto misplaced = parts.misplaced(lattice, mesh);
  ASSERT_EQ(misplaced.size(), 8U * 4 * 8 * 8);
  const ImageFrame frame = part_frame(image.frame);
  for (std::size_t n = 0; n < misplaced.size(); ++n) {
    EXPECT_EQ(misplaced[n].in_mesh, 1);
    ASSERT_GE(frame.index_of(misplaced[n].offset)[0], 8);
    ASSERT_TRUE(n == 0 || misplaced[n - 1].offset < misplaced[n].offset);
  }
  // Tets with parts of the other side, and none without.
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto& n = tets.nodes[t];
    const std::array<LatticePoint, 4> corners = {lattice.points[n[0]], lattice.points[n[1]],
                                                 lattice.points[n[2]], lattice.points[n[3]]};
    double most = -1e9;
    for (const LatticePoint& p : corners) most = std::max(most, lattice.frame.local(p).x);
    if (most < 3.7) {
      EXPECT_FALSE(parts.holds_other(corners, 1));
    }
    if (parts.holds_other(corners, 1)) {
      EXPECT_GT(most, 3.74);
    }
  }
}

}  // namespace
}  // namespace cbc3d
