#include "baselines/cleaver/triples.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "baselines/cleaver/testing_lattice.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

TEST(Triples, LieWithinTheirFacesOrOnACutOfThem) {
  const testing::RandomIndicators indicators(9, 5);
  Lattice lattice = testing::uniform_lattice(10);
  std::vector<MaterialId> materials = testing::inner_materials(lattice, indicators, 10, 1.6);
  const CutLattice cut = testing::cut_and_warped(std::move(lattice), std::move(materials), indicators);
  EXPECT_FALSE(cut.triples.empty());
  std::size_t snapped = 0;
  for (const Triple& triple : cut.triples) {
    const auto& p = cut.lattice.points;
    const Vec3 &a = p[triple.corners[0]], &b = p[triple.corners[1]], &c = p[triple.corners[2]];
    if (triple.snapped_to != kNone) {
      ++snapped;
      EXPECT_NE(std::find(triple.cuts.begin(), triple.cuts.end(), triple.snapped_to), triple.cuts.end());
      EXPECT_EQ(cut.cuts[triple.snapped_to].place, CutPlace::kWithin);
      continue;
    }
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.squared_norm();
    EXPECT_NEAR((triple.place - a).dot(normal) / area, 0, 1e-6);
    EXPECT_GT((b - a).cross(triple.place - a).dot(normal), 0.01 * area);
    EXPECT_GT((c - b).cross(triple.place - b).dot(normal), 0.01 * area);
    EXPECT_GT((a - c).cross(triple.place - c).dot(normal), 0.01 * area);
  }
  EXPECT_GT(snapped, 0U);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver
