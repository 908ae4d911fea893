#include "baselines/ld/initial_mesh.hpp"

#include <set>

#include "baselines/ld/dihedral.hpp"
#include "baselines/ld/leaf_templates.hpp"
#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d::baselines::ld {
namespace {

double least_dihedral_deg_of(const LatticeMesh& mesh, const CellGrid& grid) {
  double least = 180;
  for (const auto& n : mesh.tets) {
    const Vec3 p = grid.local_mm(mesh.points[n[3]]);
    least = std::fmin(
        least, least_dihedral_deg(grid.local_mm(mesh.points[n[0]]) - p, grid.local_mm(mesh.points[n[1]]) - p,
                                  grid.local_mm(mesh.points[n[2]]) - p));
  }
  return least;
}

class InitialMesh : public ::testing::TestWithParam<int> {
 protected:
  [[nodiscard]] static LabelImage image() {
    if (GetParam() == 0) return cbc3d::testing::touching_balls();
    if (GetParam() == 1) return cbc3d::testing::noisy_blocks_image(3, 7);
    return cbc3d::testing::random_image({9, 10, 11}, {1, 1, 1}, 2, 3);
  }
};

TEST_P(InitialMesh, HasTheVoxelsVolumesExactly) {
  const LabelImage source = image();
  const CellGrid grid(source, {.pieces = {1, 2, 1}, .block = 8});
  EXPECT_EQ(testing::volumes_of(testing::whole_initial_mesh(grid)), testing::volumes_of(grid));
}

// With background the mesh is a box: every facet but those on its six sides has two tets.
TEST_P(InitialMesh, ConformsAcrossLeavesAndBlocks) {
  const LabelImage source = image();
  const CellGrid grid(source, {.margin = 1, .block = 8});
  const LatticeMesh mesh = testing::whole_initial_mesh(grid, {.with_background = true});
  std::map<cbc3d::testing::FaceKey, int> faces;
  for (const auto& nodes : mesh.tets) {
    for (std::size_t n = 0; n < 4; ++n) ++faces[cbc3d::testing::face_key(nodes, n)];
  }
  for (const auto& [face, count] : faces) {
    bool is_on_side = false;
    for (std::size_t a = 0; a < 3; ++a) {
      const int x = mesh.points[face[0]][a];
      const bool is_flat = mesh.points[face[1]][a] == x && mesh.points[face[2]][a] == x;
      is_on_side = is_on_side || (is_flat && (x == 0 || x == 2 * grid.size()[a]));
    }
    ASSERT_EQ(count, is_on_side ? 1 : 2);
  }
  EXPECT_EQ(std::set<LatticePoint>(mesh.points.begin(), mesh.points.end()).size(), mesh.points.size());
}

TEST_P(InitialMesh, HasNoAngleBelowThatOfTheTemplates) {
  LabelImage source = image();
  for (const Vec3& spacing : {Vec3{1, 1, 1}, Vec3{0.7, 0.7, 1.6}}) {
    source.frame.spacing_mm = spacing;
    const CellGrid grid(source, {.block = 16});
    EXPECT_GE(least_dihedral_deg_of(testing::whole_initial_mesh(grid), grid),
              least_template_dihedral_deg(spacing) - 1e-9);
  }
}

TEST_P(InitialMesh, ListsEveryFacetBetweenMaterialsAsAPieceOnce) {
  const LabelImage source = image();
  const CellGrid grid(source, {.margin = 1, .block = 8});
  const LatticeMesh mesh = testing::whole_initial_mesh(grid, {.with_background = true, .with_pieces = true});
  std::map<cbc3d::testing::FaceKey, std::set<MaterialId>> materials;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      materials[cbc3d::testing::face_key(mesh.tets[t], n)].insert(mesh.materials[t]);
    }
  }
  std::set<cbc3d::testing::FaceKey> interfaces;
  for (const auto& [face, of] : materials) {
    if (of.size() == 2) interfaces.insert(face);
  }
  std::set<cbc3d::testing::FaceKey> listed;
  for (BoundaryPiece piece : mesh.pieces) {
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_EQ(piece.corners[n][a], BoundaryPiece::kUnitsPerHalfCell * mesh.points[piece.facet[n]][a]);
      }
    }
    std::sort(piece.facet.begin(), piece.facet.end());
    EXPECT_TRUE(listed.insert(piece.facet).second);
  }
  EXPECT_EQ(listed, interfaces);
}

INSTANTIATE_TEST_SUITE_P(Images, InitialMesh, ::testing::Values(0, 1, 2));

}  // namespace
}  // namespace cbc3d::baselines::ld
