// Lattice, red-green subdivision and exact voxel counting: known angles, invariants on seeded random
// refinements.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/candidate_mesh.hpp"
#include "mesher/lattice/lattice_places.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_lattice_checks.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

struct AngleRange {
  double low = 180;
  double high = 0;
};

AngleRange dihedral_range(const Lattice& lattice, const LatticeTets& tets) {
  AngleRange range;
  for (const auto& nodes : tets.nodes) {
    std::array<Vec3, 4> p;
    for (std::size_t n = 0; n < 4; ++n) {
      p[n] = lattice.frame.local(lattice.points[nodes[n]]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        std::array<std::size_t, 2> other{};
        std::size_t n = 0;
        for (std::size_t m = 0; m < 4; ++m) {
          if (m != i && m != j) other[n++] = m;
        }
        const Vec3 axis = (p[j] - p[i]).normalized();
        const Vec3 u = (p[other[0]] - p[i]) - axis * axis.dot(p[other[0]] - p[i]);
        const Vec3 v = (p[other[1]] - p[i]) - axis * axis.dot(p[other[1]] - p[i]);
        const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * 180 / std::acos(-1.0);
        range.low = std::min(range.low, angle);
        range.high = std::max(range.high, angle);
      }
    }
  }
  return range;
}

double volume(const Lattice& lattice, const LatticeTets& tets) {
  double sum = 0;
  for (const auto& n : tets.nodes) {
    const double six =
        six_volumes(lattice.frame.local(lattice.points[n[0]]), lattice.frame.local(lattice.points[n[1]]),
                    lattice.frame.local(lattice.points[n[2]]), lattice.frame.local(lattice.points[n[3]]));
    EXPECT_GT(six, 0);
    sum += six / 6;
  }
  return sum;
}

/// Area of the faces that have one tet only. Throws when a face has more than two.
double hull_area(const Lattice& lattice, const LatticeTets& tets) {
  const auto neighbours = tet_neighbours(tets.nodes, lattice.points.size());
  double area = 0;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (neighbours[t][n] == kNoTet) {
        const auto at = [&](std::size_t c) {
          return lattice.frame.local(lattice.points[tets.nodes[t][kTetFace[n][c]]]);
        };
        area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
      }
    }
  }
  return area;
}

Lattice lattice_of(const LabelImage& image, double spacing_mm, double finest_mm) {
  return build_bcc_lattice(image, {spacing_mm, finest_mm});
}

void refine_at_random(Lattice& lattice, int rounds, std::uint32_t seed, std::uint32_t one_in) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::uint8_t> marked(lattice.reds.size());
    for (auto& m : marked) {
      m = static_cast<std::uint8_t>(random() % one_in == 0);
    }
    refine_red_green(lattice, marked);
  }
}

TEST(BccLattice, HasTheDihedralAnglesOfTheBccTet) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  const Lattice lattice = lattice_of(image, 5, 1);
  const LatticeTets tets = extract_tets(lattice);
  ASSERT_GT(tets.size(), 100U);
  const AngleRange range = dihedral_range(lattice, tets);
  EXPECT_NEAR(range.low, 60, 1e-9);
  EXPECT_NEAR(range.high, 90, 1e-9);
  EXPECT_NEAR(volume(lattice, tets), static_cast<double>(tets.size()) * 125 / 12,
              1e-6);  // each tet: a^3 / 12
}

TEST(BccLattice, InnerVerticesHave24TetsAnd14Edges) {
  const LabelImage image = testing::ball_image(40, 1, 18);
  const Lattice lattice = lattice_of(image, 5, 5);
  const LatticeTets tets = extract_tets(lattice);
  const VertexTets around = tets_of_vertices(tets.nodes, lattice.points.size());
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
  const Lattice lattice = lattice_of(image, 5, 5);
  const LatticeTets tets = extract_tets(lattice);
  const VertexTets around = tets_of_vertices(tets.nodes, lattice.points.size());
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

TEST(RedGreen, RandomRefinementStaysConformingWithinTheTemplatesAngles) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    Lattice lattice = lattice_of(image, 6, 0.3);
    const double before = volume(lattice, extract_tets(lattice));
    const double hull_before = hull_area(lattice, extract_tets(lattice));
    refine_at_random(lattice, 4, seed, 20);
    const LatticeTets tets = extract_tets(lattice);
    const AngleRange range = dihedral_range(lattice, tets);
    EXPECT_GE(range.low, 29.999999);  // the paper: 30 and 116.5 degrees
    EXPECT_LE(range.high, 116.5651);
    EXPECT_NEAR(volume(lattice, tets), before, 1e-9 * before);
    // Conforming: no face has more than two tets (tet_neighbours would throw), and faces with one tet lie on
    // the hull, whose area refinement does not change; a T-junction would add inner ones.
    EXPECT_NEAR(hull_area(lattice, tets), hull_before, 1e-9 * hull_before);
    EXPECT_GT(std::accumulate(tets.green.begin(), tets.green.end(), 0), 100);
  }
}

TEST(RedGreen, ARefinerThatRemembersSplitsAsOneThatLooksAtAll) {
  const LabelImage image = testing::ball_image(40, 1, 17);
  Lattice kept = lattice_of(image, 4, 0.2);
  Lattice anew = lattice_of(image, 4, 0.2);
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
    testing::expect_same_lattice(kept, anew);
  }
  EXPECT_GT(hull_area(kept, extract_tets(kept)), 0);  // conforming
}

TEST(LatticeFollower, AMeshThatFollowsIsTheMeshMadeAnew) {
  const LabelImage image = testing::ball_image(24, 1, 9);
  Lattice lattice = lattice_of(image, 6, 0.3);
  LatticeFollower follower(lattice);
  CandidateMesh mesh;
  TetNodes nodes;  // of the tets, carried along
  for (const std::uint32_t one_in : {20U, 500U, 5000U, 1000000000U}) {
    const UninitializedVector<TetId> number = follower.renumber();
    follower.rebuild(mesh, number);
    const LatticeTets tets = extract_tets(lattice);
    EXPECT_EQ(mesh.tets.nodes, tets.nodes);
    EXPECT_EQ(mesh.tets.parent, tets.parent);
    EXPECT_EQ(mesh.tets.green, tets.green);
    EXPECT_EQ(mesh.neighbours, tet_neighbours(tets.nodes, lattice.points.size()));
    nodes = renumbered(nodes, number, tets.size(), {0, 0, 0, 0});
    const auto kept =
        number.size() - static_cast<std::size_t>(std::count(number.begin(), number.end(), kNoTet));
    std::size_t alike = 0;
    for (std::size_t t = 0; t < tets.size(); ++t) {
      EXPECT_LE(follower.first(tets.parent[t]), t);
      EXPECT_LT(t, follower.first(tets.parent[t] + 1));
      alike += nodes[t] == tets.nodes[t] ? 1 : 0;
    }
    EXPECT_EQ(alike, kept);
    EXPECT_TRUE(one_in < 5000U || kept > tets.size() / 2) << kept << " of " << tets.size();
    nodes = tets.nodes;
    refine_at_random(lattice, 1, one_in, one_in);
  }
}

TEST(LatticePlaces, NoTetThatHoldsAPlaceIsPassedOver) {
  const LabelImage image = testing::make_image({40, 30, 20}, {0.9, 1.1, 1.3}, 1, [](const Vec3& p) {
    return (p - Vec3{18, 16, 13}).norm() < 11 ? 1 : 0;
  });
  Lattice lattice = lattice_of(image, 7.3, 0.5);
  refine_at_random(lattice, 3, 3, 8);
  const VoxelRaster raster(image.frame, lattice.frame);
  LatticePlaces places(image.frame, lattice.frame);
  for (const std::size_t voxel : {std::size_t{0}, std::size_t{12345}, image.voxels.size() - 1}) {
    const Index3 at = image.frame.index_of(voxel);
    places.clear();
    places.add(image.frame.local_centre(at[0], at[1], at[2]));
    std::size_t passed_over = 0;
    for (const RedTet& red : lattice.reds) {
      const bool may_hold = places.may_hold(lattice.points[red.nodes[0]], red.level);
      passed_over += may_hold ? 0 : 1;
      raster.for_each_row({lattice.points[red.nodes[0]], lattice.points[red.nodes[1]],
                           lattice.points[red.nodes[2]], lattice.points[red.nodes[3]]},
                          [&](int j, int k, int begin, int end) {
                            const bool holds = j == at[1] && k == at[2] && begin <= at[0] && at[0] < end;
                            EXPECT_TRUE(may_hold || !holds);
                          });
    }
    EXPECT_GT(passed_over, lattice.reds.size() / 2);
  }
}

TEST(VoxelRaster, EveryVoxelLiesInExactlyOneTet) {
  // Spacings for which many voxel centres fall exactly on lattice faces, and one for which none does.
  for (const double spacing : {1.0, 0.5, 0.73}) {
    const LabelImage image =
        testing::make_image({20, 18, 16}, {spacing, spacing, 2 * spacing}, 1, [](const Vec3&) { return 1; });
    Lattice lattice = lattice_of(image, 8 * spacing, spacing / 2);
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

TEST(VoxelRaster, AgreesWithAPointInTetTest) {
  const LabelImage image =
      testing::make_image({16, 16, 16}, {0.9, 1.1, 1.3}, 1, [](const Vec3&) { return 1; });
  Lattice lattice = lattice_of(image, 7.3, 1);
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
