#include "baselines/cleaver/tet_stencil.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "baselines/cleaver/testing_lattice.hpp"
#include "baselines/cleaver/tet_angles.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

struct Angles {
  double least_deg = 180, most_deg = 0;
  std::size_t tets = 0, inverted = 0;
};

// The angles of the pieces of all lattice tets with at most so many materials.
Angles angles_of_pieces(const CutLattice& cut, std::size_t most_materials) {
  Angles angles;
  for (const MixedTet& mixed : cut.mixed) {
    if (testing::materials_of_tet(cut, mixed.tet) > most_materials) continue;
    ++angles.tets;
    TetState state = state_of(cut, mixed);
    const TetPieces pieces = pieces_of(state);
    state.places[kQuad] = pieces.quad_place;
    for (std::size_t n = 0; n < pieces.count; ++n) {
      const auto& p = pieces.pieces[n].points;
      const CosineRange range =
          dihedral_cosines({state.places[p[0]], state.places[p[1]], state.places[p[2]], state.places[p[3]]});
      if (range.most > 1) {
        ++angles.inverted;
        continue;
      }
      angles.least_deg = std::min(angles.least_deg, std::acos(range.most) * 180 / std::numbers::pi);
      angles.most_deg = std::max(angles.most_deg, std::acos(range.least) * 180 / std::numbers::pi);
    }
  }
  return angles;
}

CutLattice random_cut(int cells, std::uint64_t seed, int materials) {
  const testing::RandomIndicators indicators(seed, materials);
  Lattice lattice = testing::uniform_lattice(cells);
  std::vector<MaterialId> of_vertices = testing::inner_materials(lattice, indicators, cells, 1.6);
  return testing::cut_and_warped(std::move(lattice), std::move(of_vertices), indicators);
}

// A million lattice tets with any labels at their corners and any cuts: the angles are within the published
// bounds, for four materials as well, for which the original has none.
TEST(TetStencil, AnyLabelsAndCutsGiveAnglesWithinTheBounds) {
  std::size_t tets = 0;
  for (std::uint64_t seed = 0; tets < 1000000; ++seed) {
    const int materials = 2 + static_cast<int>(seed % 7);
    const Angles angles = angles_of_pieces(random_cut(16, seed, materials), 4);
    tets += angles.tets;
    ASSERT_EQ(angles.inverted, 0U) << seed;
    ASSERT_GE(angles.least_deg, kLeastAngleDeg) << seed;
    ASSERT_LE(angles.most_deg, kMostAngleDeg) << seed;
  }
}

TEST(TetStencil, PlanesAtAnyPlaceGiveAnglesWithinTheBounds) {
  std::mt19937 random(11);
  for (int round = 0; round < 100; ++round) {
    const Vec3 normal = cbc3d::testing::draw_point(random, -1, 1).normalized();
    const testing::PlaneIndicators plane(normal, normal.dot({4, 4, 4}) + cbc3d::testing::draw(random, -1, 1));
    Lattice lattice = testing::uniform_lattice(8);
    std::vector<MaterialId> materials = testing::materials_at(lattice.points, plane);
    const CutLattice cut = testing::cut_and_warped(std::move(lattice), std::move(materials), plane);
    const Angles angles = angles_of_pieces(cut, 2);
    ASSERT_EQ(angles.inverted, 0U);
    ASSERT_GE(angles.least_deg, kLeastAngleDeg);
    ASSERT_LE(angles.most_deg, kMostAngleDeg);
  }
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver
