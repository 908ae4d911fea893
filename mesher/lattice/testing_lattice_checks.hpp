// What two lattices have in common.
#pragma once

#include <gtest/gtest.h>

#include "mesher/lattice/lattice.hpp"

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

}  // namespace cbc3d::testing
