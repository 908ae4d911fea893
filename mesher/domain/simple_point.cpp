#include "mesher/domain/simple_point.hpp"

#include <bit>
#include <cstdint>

namespace cbc3d {
namespace {

/// Bit n for the n-th of the 27 voxels.
using Voxels = std::uint32_t;

constexpr std::size_t kCentre = 13;
constexpr Voxels kAll = (1U << 27U) - 1;

struct Tables {
  Voxels faces = 0;   // the 6 that share a face with the voxel in the middle
  Voxels edges = 0;   // the 18 that share a face or an edge with it
  Voxels others = 0;  // all but itself
  std::array<Voxels, 27> across_faces{};
  std::array<Voxels, 27> across_corners{};
};

constexpr int magnitude(int step) {
  return step < 0 ? -step : step;
}

constexpr Tables make_tables() {
  Tables tables;
  tables.others = kAll & ~(1U << kCentre);
  for (int a = 0; a < 27; ++a) {
    for (int b = 0; b < 27; ++b) {
      const int x = magnitude(a % 3 - b % 3);
      const int y = magnitude(a / 3 % 3 - b / 3 % 3);
      const int z = magnitude(a / 9 - b / 9);
      const Voxels bit = 1U << static_cast<unsigned>(b);
      const auto from = static_cast<std::size_t>(a);
      tables.across_faces[from] |= x + y + z == 1 ? bit : 0;
      tables.across_corners[from] |= a != b && x < 2 && y < 2 && z < 2 ? bit : 0;
      tables.edges |= from == kCentre && x + y + z > 0 && x + y + z < 3 ? bit : 0;
    }
  }
  tables.faces = tables.across_faces[kCentre];
  return tables;
}

constexpr Tables kTables = make_tables();

/// How many components `set` has that hold one of `seeds`.
int count_components(Voxels set, Voxels seeds, const std::array<Voxels, 27>& neighbours) {
  int components = 0;
  for (seeds &= set; seeds != 0; seeds &= set) {
    ++components;
    Voxels front = seeds & (~seeds + 1);  // the lowest of them
    while (front != 0) {
      set &= ~front;
      Voxels next = 0;
      for (; front != 0; front &= front - 1) {
        next |= neighbours[static_cast<std::size_t>(std::countr_zero(front))];
      }
      front = next & set;
    }
  }
  return components;
}

}  // namespace

Index3 voxel_neighbour(const Index3& at, std::size_t n) {
  const int s = static_cast<int>(n);
  return {at[0] + s % 3 - 1, at[1] + s / 3 % 3 - 1, at[2] + s / 9 - 1};
}

bool is_simple(const VoxelNeighbourhood& around) {
  Voxels own = 0;
  for (std::size_t n = 0; n < around.size(); ++n) {
    own |= around[n] ? 1U << n : 0;
  }
  // Own ones are joined across faces, among those that share a face or an edge with the voxel.
  return count_components(own & kTables.edges, kTables.faces, kTables.across_faces) == 1 &&
         count_components(~own & kTables.others, kTables.others, kTables.across_corners) == 1;
}

}  // namespace cbc3d
