#include "mesher/domain/simple_point.hpp"

#include <algorithm>
#include <cstdlib>

namespace cbc3d {
namespace {

constexpr std::size_t kCentre = 13;

Index3 step_to(std::size_t n) {
  return voxel_neighbour({0, 0, 0}, n);
}

int length(const Index3& d) {
  return std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
}

/// Across a face for voxels of the set, across a face, an edge or a corner for others.
bool are_joined(std::size_t m, std::size_t n, bool own) {
  const Index3 a = step_to(m);
  const Index3 b = step_to(n);
  const Index3 d = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  return own ? length(d) == 1 : std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) == 1;
}

/// The components of those neighbours that are (not) of the set: its own within the 18 that share a face or
/// an edge with the voxel, and only such components as touch it by a face.
int count_pieces(const VoxelNeighbourhood& around, bool own) {
  std::array<bool, 27> seen{};
  const auto usable = [&](std::size_t n) {
    return n != kCentre && !seen[n] && around[n] == own && (!own || length(step_to(n)) < 3);
  };
  int pieces = 0;
  for (std::size_t start = 0; start < 27; ++start) {
    if (!usable(start) || (own && length(step_to(start)) != 1)) {
      continue;
    }
    ++pieces;
    std::array<std::size_t, 27> stack{start};
    seen[start] = true;
    for (std::size_t count = 1; count > 0;) {
      const std::size_t a = stack[--count];
      for (std::size_t n = 0; n < 27; ++n) {
        if (usable(n) && are_joined(a, n, own)) {
          seen[n] = true;
          stack[count++] = n;
        }
      }
    }
  }
  return pieces;
}

}  // namespace

Index3 voxel_neighbour(const Index3& at, std::size_t n) {
  const int s = static_cast<int>(n);
  return {at[0] + s % 3 - 1, at[1] + s / 3 % 3 - 1, at[2] + s / 9 - 1};
}

bool is_simple(const VoxelNeighbourhood& around) {
  return count_pieces(around, true) == 1 && count_pieces(around, false) == 1;
}

}  // namespace cbc3d
