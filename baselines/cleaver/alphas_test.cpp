#include "baselines/cleaver/alphas.hpp"

#include <gtest/gtest.h>

#include "baselines/cleaver/testing_lattice.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

CutLattice cut_at_random(Lattice lattice, double edge) {
  const testing::RandomIndicators indicators(1, 3);
  std::vector<MaterialId> materials = testing::inner_materials(lattice, indicators, edge, 0);
  CutLattice cut = cut_edges(std::move(lattice), std::move(materials), indicators);
  set_alphas(cut);
  return cut;
}

TEST(Alphas, AreThePublishedOnesOnTheUniformLattice) {
  const CutLattice cut = cut_at_random(testing::uniform_lattice(6), 6);
  for (const Cut& c : cut.cuts) {
    const double length = (cut.lattice.points[c.first] - cut.lattice.points[c.second]).norm();
    const auto alpha = static_cast<float>(length > 0.95 ? kLongAlpha : kShortAlpha);
    ASSERT_EQ(c.alpha_first, alpha);
    ASSERT_EQ(c.alpha_second, alpha);
  }
}

// However the vertices of a tet move by their alphas, it stays positive.
TEST(Alphas, AreSafeOnGradedLattices) {
  std::mt19937 random(7);
  const CutLattice cut = cut_at_random(testing::graded_lattice(24, random), 24);
  std::vector<double> reach(cut.lattice.points.size(), 0);
  for (const Cut& c : cut.cuts) {
    const double length = (cut.lattice.points[c.first] - cut.lattice.points[c.second]).norm();
    ASSERT_LT(c.alpha_first + c.alpha_second, 1);
    reach[c.first] = std::max(reach[c.first], c.alpha_first * length);
    reach[c.second] = std::max(reach[c.second], c.alpha_second * length);
  }
  std::size_t moved = 0;
  for (const auto& nodes : cut.lattice.tets) {
    std::array<Vec3, 4> p;
    for (std::size_t n = 0; n < 4; ++n) p[n] = cut.lattice.points[nodes[n]];
    bool regular = true;
    for (std::size_t e = 0; e < 6; ++e) {
      const double length = (p[kTetEdge[e][0]] - p[kTetEdge[e][1]]).norm();
      regular = regular && std::abs(length - std::round(length)) *
                                   std::abs(length / std::sqrt(0.75) - std::round(length / std::sqrt(0.75))) <
                               1e-9;
    }
    if (regular) continue;
    for (int round = 0; round < 20; ++round) {
      std::array<Vec3, 4> q = p;
      for (std::size_t n = 0; n < 4; ++n)
        q[n] += cbc3d::testing::draw_point(random, -1, 1).normalized() * std::min(reach[nodes[n]], 1e9);
      moved += six_volumes(q[0], q[1], q[2], q[3]) > 0 ? 0 : 1;
    }
  }
  EXPECT_EQ(moved, 0U);
}

}  // namespace
}  // namespace cbc3d::baselines::cleaver
