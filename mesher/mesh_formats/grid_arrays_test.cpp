#include "mesher/mesh_formats/grid_arrays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

/// A tet of label 3 and a triangle.
GridArrays sample() {
  return {.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          .types = {10, 5},
          .offsets = {0, 4, 7},
          .connectivity = {0, 1, 2, 3, 0, 1, 2},
          .labels = {3, 0.5}};
}

TEST(GridArrays, VolumeCellsBecomeAMesh) {
  const Mesh mesh = mesh_of_grid(sample(), "'m.vtu'");
  EXPECT_EQ(mesh.tets.size(), 1U);
  EXPECT_EQ(mesh.tets.labels[0], 3);
  EXPECT_EQ(mesh.points.size(), 4U);
}

TEST(GridArrays, WhatDoesNotGoTogetherIsRefused) {
  const std::pair<std::function<void(GridArrays&)>, const char*> damages[] = {
      {[](GridArrays& g) { g.labels.pop_back(); }, "1 labels"},
      {[](GridArrays& g) { g.types.push_back(10); }, "3 cell types"},
      {[](GridArrays& g) { g.offsets.clear(); }, "0 cells"},
      {[](GridArrays& g) { g.offsets[1] = 9; }, "offset 9"},
      {[](GridArrays& g) { g.offsets[0] = -1; }, "offset -1"},
      {[](GridArrays& g) { g.offsets[1] = 3; }, "3 nodes, not 4"},
      {[](GridArrays& g) { g.types[0] = 12; }, "4 nodes, not 8"},
      {[](GridArrays& g) { g.connectivity[2] = 4; }, "node 4"},
      {[](GridArrays& g) { g.connectivity[2] = -1; }, "node -1"},
      {[](GridArrays& g) { g.connectivity[2] = std::int64_t{1} << 32U; }, "node 4294967296"},
      {[](GridArrays& g) { g.points[1].y = std::nan(""); }, "point 1"},
      {[](GridArrays& g) { g.labels[0] = 1.5; }, "label 1.5"},
      {[](GridArrays& g) { g.labels[0] = std::nan(""); }, "label nan"},
      {[](GridArrays& g) { g.labels[0] = 1e12; }, "label 1000000000000"},
      {[](GridArrays& g) { g.types[0] = 24; }, "VTK type 24"},
      {[](GridArrays& g) { g.types[0] = 5; }, "no tets"}};
  for (const auto& [damage, words] : damages) {
    GridArrays grid = sample();
    damage(grid);
    try {
      mesh_of_grid(grid, "'m.vtu'");
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_TRUE(std::string(error.what()).starts_with("'m.vtu': "));
    }
  }
}

}  // namespace
}  // namespace cbc3d
