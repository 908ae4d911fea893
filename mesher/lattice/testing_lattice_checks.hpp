// Refined lattices, and what is true of their tets.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d::testing {

/// The same vertices and red tets in the same order, with the same edges split.
inline void expect_same_lattice(const Lattice& lattice, const Lattice& wanted) {
  ASSERT_EQ(lattice.points, wanted.points);
  ASSERT_EQ(lattice.split_below, wanted.split_below);
  ASSERT_EQ(lattice.reds.size(), wanted.reds.size());
  for (std::size_t r = 0; r < wanted.reds.size(); ++r) {
    ASSERT_EQ(lattice.reds[r].nodes, wanted.reds[r].nodes);
    ASSERT_EQ(lattice.reds[r].level, wanted.reds[r].level);
    ASSERT_EQ(lattice.reds[r].split, wanted.reds[r].split);
  }
}

inline double volume_of_lattice(const Lattice& lattice, const LatticeTets& tets) {
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
inline double hull_area(const Lattice& lattice, const LatticeTets& tets) {
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

inline void refine_at_random(Lattice& lattice, int rounds, std::uint32_t seed, std::uint32_t one_in) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    std::vector<std::uint8_t> marked(lattice.reds.size());
    for (auto& m : marked) {
      m = static_cast<std::uint8_t>(random() % one_in == 0);
    }
    refine_red_green(lattice, marked);
  }
}

struct AngleRange {
  double low = 180;
  double high = 0;
};

inline AngleRange dihedral_range(const Lattice& lattice, const LatticeTets& tets) {
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

/// Rounds in which many tets split at once, and then few.
inline Lattice refined_lattice() {
  Lattice lattice = build_bcc_lattice(ball_image(40, 1, 17), {3, 0.3});
  RedGreenRefiner refiner(lattice);
  std::mt19937 random(7);
  for (const std::uint32_t one_in : {4U, 40U, 4000U}) {
    std::vector<std::uint8_t> marked(lattice.reds.size());
    std::generate(marked.begin(), marked.end(),
                  [&] { return static_cast<std::uint8_t>(random() % one_in == 0); });
    refiner.refine(marked);
  }
  return lattice;
}

}  // namespace cbc3d::testing
