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
  // The mesh calls everything background: what is misplaced are the label's parts, all of them.
  CandidateMesh mesh{.tets = tets, .materials = std::vector<MaterialId>(tets.size(), 0), .neighbours = {}};
  const auto misplaced = parts.misplaced(lattice, mesh);
  ASSERT_EQ(misplaced.size(), 8U * 4 * 8 * 8);
  const ImageFrame frame = part_frame(image.frame);
  for (std::size_t n = 0; n < misplaced.size(); ++n) {
    EXPECT_EQ(misplaced[n].in_mesh, 0);
    ASSERT_LT(frame.index_of(misplaced[n].offset)[0], 8);
    ASSERT_TRUE(n == 0 || misplaced[n - 1].offset < misplaced[n].offset);
  }
  // No tet beyond the label's last part holds one of the label.
  for (const auto& n : tets.nodes) {
    const std::array<LatticePoint, 4> corners = {lattice.points[n[0]], lattice.points[n[1]],
                                                 lattice.points[n[2]], lattice.points[n[3]]};
    double least = 1e9;
    for (const LatticePoint& p : corners) least = std::min(least, lattice.frame.local(p).x);
    if (least > 3.3) {
      EXPECT_FALSE(parts.holds_other(corners, 0));
    }
    if (parts.holds_other(corners, 0)) {
      EXPECT_LT(least, 3.26);
    }
  }
}

}  // namespace
}  // namespace cbc3d
