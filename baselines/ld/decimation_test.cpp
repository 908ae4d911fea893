#include "baselines/ld/decimation.hpp"

#include "baselines/ld/dihedral.hpp"
#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d::baselines::ld {
namespace {

LabelImage cube(int side) {
  return cbc3d::testing::make_image({side, side, side}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
}

TEST(Decimation, LeavesAFewTetsOfACube) {
  const LabelImage image = cube(20);
  const CellGrid grid(image, {.block = 32});
  const LatticeMesh left = decimated(testing::whole_initial_mesh(grid), grid, {});
  EXPECT_LE(left.tets.size(), 12U);
  EXPECT_EQ(testing::volumes_of(left), testing::volumes_of(grid));
}

TEST(Decimation, WithoutDistancesKeepsVolumesAndTopologyOfAnyImage) {
  for (std::uint32_t seed = 1; seed <= 4; ++seed) {
    const LabelImage image = seed % 2 == 0 ? cbc3d::testing::noisy_blocks_image(3, seed)
                                           : cbc3d::testing::random_image({10, 9, 8}, {1, 1, 1}, 3, seed);
    const CellGrid grid(image, {.block = 32});
    const LatticeMesh before = testing::whole_initial_mesh(grid);
    const LatticeMesh after = decimated(before, grid, {});
    EXPECT_LT(after.tets.size(), before.tets.size());
    EXPECT_EQ(testing::volumes_of(after), testing::volumes_of(grid));
    EXPECT_EQ(testing::surface_characteristics(after), testing::surface_characteristics(before));
    EXPECT_EQ(cbc3d::testing::crowded_faces(testing::nodes_of(after)), 0U);
  }
}

TEST(Decimation, WithDistancesKeepsTheBoxAndTheTopologyOfAllMaterials) {
  for (const LabelImage& image : {cbc3d::testing::touching_balls(), cbc3d::testing::cavity_and_torus(),
                                  cbc3d::testing::noisy_blocks_image(3, 9)}) {
    const CellGrid grid(image, {.margin = 2, .block = 64});
    const LatticeMesh before =
        testing::whole_initial_mesh(grid, {.with_background = true, .with_pieces = true});
    const LatticeMesh after = decimated(before, grid, {.distances = {1.5, 1.5}});
    std::int64_t box = 0;
    for (const auto& [material, volume] : testing::volumes_of(after)) box += volume;
    EXPECT_EQ(box, std::int64_t{6} * 8 * grid.size()[0] * grid.size()[1] * grid.size()[2]);
    EXPECT_LT(after.tets.size(), before.tets.size() / 2);
    EXPECT_EQ(testing::surface_characteristics(after), testing::surface_characteristics(before));
  }
}

TEST(Decimation, KeepsBothAngleBounds) {
  const LabelImage image = cbc3d::testing::touching_balls();
  const CellGrid grid(image, {.block = 32});
  for (const double most_deg : {130.0, 150.0}) {
    const LatticeMesh left = decimated(testing::whole_initial_mesh(grid), grid,
                                       {.min_dihedral_deg = 20, .max_dihedral_deg = most_deg});
    const DihedralBounds bounds(20 - 1e-6, most_deg + 1e-6);
    for (const auto& n : left.tets) {
      const Vec3 p = grid.local_mm(left.points[n[3]]);
      EXPECT_TRUE(bounds.accept(grid.local_mm(left.points[n[0]]) - p, grid.local_mm(left.points[n[1]]) - p,
                                grid.local_mm(left.points[n[2]]) - p));
    }
  }
}

TEST(Decimation, FrozenVerticesStay) {
  const LabelImage image = cube(4);
  const CellGrid grid(image, {.block = 4});
  LatticeMesh mesh = testing::whole_initial_mesh(grid);
  for (VertexState& state : mesh.states) state.is_frozen = true;
  const std::size_t tets = mesh.tets.size();
  EXPECT_EQ(decimated(std::move(mesh), grid, {}).tets.size(), tets);
}

}  // namespace
}  // namespace cbc3d::baselines::ld
