// Which tet a voxel lies in: exactly one, and that which holds its centre.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::refine_at_random;

TEST(VoxelRaster, EveryVoxelLiesInExactlyOneTet) {
  // Spacings for which many voxel centres fall exactly on lattice faces, and one for which none does.
  for (const double spacing : {1.0, 0.5, 0.73}) {
    const LabelImage image =
        testing::make_image({20, 18, 16}, {spacing, spacing, 2 * spacing}, 1, [](const Vec3&) { return 1; });
    Lattice lattice = build_bcc_lattice(image, {8 * spacing, spacing / 2});
    refine_at_random(lattice, 3, 7, 10);
    const LatticeTets tets = extract_tets(lattice);
    const VoxelRaster raster(image.frame, lattice.frame);
    std::vector<int> hits(image.voxels.size(), 0);
    for (const auto& n : tets.nodes) {
      raster.for_each_row(
          {lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]},
          [&](int j, int k, int begin, int end) {
            for (int i = begin; i < end; ++i) {
              ++hits[image.frame.offset(i, j, k)];
            }
          });
    }
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), static_cast<std::ptrdiff_t>(hits.size()))
        << "spacing " << spacing;
  }
}

TEST(VoxelRaster, PartsOfVoxelsAreThoseOfTheFinerImage) {
  const LabelImage image = testing::make_image({8, 7, 6}, {1, 1, 2}, 1, [](const Vec3&) { return 1; });
  Lattice lattice = build_bcc_lattice(image, {4, 0.5});
  refine_at_random(lattice, 2, 5, 10);
  const LatticeTets tets = extract_tets(lattice);
  const VoxelRaster raster(image.frame, lattice.frame, {2, 2, 4});
  const ImageFrame finer{.size = {16, 14, 24}};
  std::vector<int> hits(finer.voxel_count(), 0);
  for (const auto& n : tets.nodes) {
    raster.for_each_row(
        {lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]},
        [&](int j, int k, int begin, int end) {
          for (int i = begin; i < end; ++i) ++hits[finer.offset(i, j, k)];
        });
  }
  EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), static_cast<std::ptrdiff_t>(hits.size()));
}

TEST(VoxelRaster, AgreesWithAPointInTetTest) {
  const LabelImage image =
      testing::make_image({16, 16, 16}, {0.9, 1.1, 1.3}, 1, [](const Vec3&) { return 1; });
  Lattice lattice = build_bcc_lattice(image, {7.3, 1});
  refine_at_random(lattice, 2, 3, 8);
  const LatticeTets tets = extract_tets(lattice);
  const VoxelRaster raster(image.frame, lattice.frame);
  for (std::size_t t = 0; t < tets.size(); t += 17) {
    const auto& n = tets.nodes[t];
    std::array<Vec3, 4> p;
    for (std::size_t c = 0; c < 4; ++c) p[c] = lattice.frame.local(lattice.points[n[c]]);
    std::vector<std::uint8_t> in(image.voxels.size(), 0);
    raster.for_each_row(
        {lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]},
        [&](int j, int k, int begin, int end) {
          for (int i = begin; i < end; ++i) in[image.frame.offset(i, j, k)] = 1;
        });
    for (std::size_t v = 0; v < in.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      const Vec3 x = image.frame.local_centre(at[0], at[1], at[2]);
      const double least = std::min({six_volumes(x, p[1], p[2], p[3]), six_volumes(p[0], x, p[2], p[3]),
                                     six_volumes(p[0], p[1], x, p[3]), six_volumes(p[0], p[1], p[2], x)});
      if (std::abs(least) > 1e-3) {  // away from the faces both must say the same
        EXPECT_EQ(in[v] == 1, least > 0);
      }
    }
  }
}

}  // namespace
}  // namespace cbc3d
