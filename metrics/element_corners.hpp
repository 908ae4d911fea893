// The corners of each kind of cell in the node order of mesh.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// A corner of a cell by local node numbers: the edges from `at` to the other three are right-handed where
/// the cell is positive.
struct Corner {
  std::size_t at, next, previous, up;
};

/// At the apex of a pyramid four edges meet; each three neighbouring ones of them make a corner of their own.
inline constexpr std::array<Corner, 4> kPyramidBaseCorners{
    {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}}};
inline constexpr std::array<Corner, 4> kPyramidApexCorners{
    {{4, 1, 0, 2}, {4, 2, 1, 3}, {4, 3, 2, 0}, {4, 0, 3, 1}}};
inline constexpr std::array<Corner, 6> kWedgeCorners{
    {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5}, {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}}};
inline constexpr std::array<Corner, 8> kHexCorners{{{0, 1, 3, 4},
                                                    {1, 2, 0, 5},
                                                    {2, 3, 1, 6},
                                                    {3, 0, 2, 7},
                                                    {4, 7, 5, 0},
                                                    {5, 4, 6, 1},
                                                    {6, 5, 7, 2},
                                                    {7, 6, 4, 3}}};

/// The smallest value over the corners of `measure`, which takes the three edges from a corner.
template <std::size_t Corners, std::size_t Points, typename Measure>
double smallest_at_corners(const std::array<Corner, Corners>& corners, const std::array<Vec3, Points>& p,
                           const Measure& measure) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Corner& c : corners) {
    const Vec3& origin = p[c.at];
    smallest = std::min(smallest, measure(p[c.next] - origin, p[c.previous] - origin, p[c.up] - origin));
  }
  return smallest;
}

/// The positions of the first N nodes of a cell.
template <std::size_t N>
std::array<Vec3, N> node_positions(const CellView& cell, const std::vector<Vec3>& points) {
  std::array<Vec3, N> p;
  for (std::size_t n = 0; n < N; ++n) {
    p[n] = points[cell.nodes[n]];
  }
  return p;
}

}  // namespace cbc3d::metrics
