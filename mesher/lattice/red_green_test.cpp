// Red-green subdivision: angles and conformity on seeded random refinements, by one thread and by several.
#include <gtest/gtest.h>
#include <omp.h>

#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

using testing::AngleRange;
using testing::at_thread_counts;
using testing::dihedral_range;
using testing::expect_same_lattice;
using testing::hull_area;
using testing::refine_at_random;
using testing::refined_lattice;
using testing::volume_of_lattice;

TEST(RedGreen, RandomRefinementStaysConformingWithinTheTemplatesAngles) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    Lattice lattice = build_bcc_lattice(image, {6, 0.3});
    const double before = volume_of_lattice(lattice, extract_tets(lattice));
    const double hull_before = hull_area(lattice, extract_tets(lattice));
    refine_at_random(lattice, 4, seed, 20);
    const LatticeTets tets = extract_tets(lattice);
    const AngleRange range = dihedral_range(lattice, tets);
    EXPECT_GE(range.low, 29.999999);  // the paper: 30 and 116.5 degrees
    EXPECT_LE(range.high, 116.5651);
    EXPECT_NEAR(volume_of_lattice(lattice, tets), before, 1e-9 * before);
    // Conforming: no face has more than two tets (tet_neighbours would throw), and faces with one tet lie on
    // the hull, whose area refinement does not change; a T-junction would add inner ones.
    EXPECT_NEAR(hull_area(lattice, tets), hull_before, 1e-9 * hull_before);
    EXPECT_GT(std::accumulate(tets.green.begin(), tets.green.end(), 0), 100);
  }
}

TEST(RedGreen, ARefinerThatRemembersSplitsAsOneThatLooksAtAll) {
  const LabelImage image = testing::ball_image(40, 1, 17);
  Lattice kept = build_bcc_lattice(image, {4, 0.2});
  Lattice anew = build_bcc_lattice(image, {4, 0.2});
  RedGreenRefiner refiner(kept);
  std::mt19937 random(4);
  for (int round = 0; round < 12; ++round) {
    // One tet and its neighbourhood down to the deepest level in the end, so that the closure has far to go.
    std::vector<std::uint8_t> marked(kept.reds.size(), 0);
    for (int n = 0; n < (round < 2 ? 1000 : 3); ++n) {
      marked[random() % marked.size()] = 1;
    }
    marked[kept.reds.size() / 2] = marked.back() = 1;
    EXPECT_EQ(refiner.refine(marked), refine_red_green(anew, marked));
    expect_same_lattice(kept, anew);
  }
  EXPECT_GT(hull_area(kept, extract_tets(kept)), 0);  // conforming
}

TEST(RedGreen, SplitsManyTetsAtOnceAsOneAfterTheOther) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Lattice wanted = refined_lattice();
  omp_set_num_threads(before);
  ASSERT_GT(wanted.reds.size(), 50000U);
  at_thread_counts([&] {
    const Lattice lattice = refined_lattice();
    expect_same_lattice(lattice, wanted);
    for (std::size_t v = 0; v < wanted.points.size(); ++v) {
      ASSERT_EQ(lattice.table.find(wanted.points[v]), v);
    }
  });
}

}  // namespace
}  // namespace cbc3d
