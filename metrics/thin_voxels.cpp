#include "metrics/thin_voxels.hpp"

#include <cstddef>

namespace cbc3d::metrics {
namespace {

// A window of rows along x, a bit for each voxel: the voxels near a place, those that a block around them
// reaches, and those that this block's own voxels reach.
constexpr int kMargin = 2;  // an erosion and a dilation by one voxel each
constexpr int kSide = 2 * (kThinReach + kMargin) + 1;
using Window = std::array<std::array<unsigned, kSide>, kSide>;

Window load(const LabelImage& image, const Index3& centre, MaterialId material, bool complement) {
  Window window{};
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      unsigned row = 0;
      for (int x = 0; x < kSide; ++x) {
        constexpr int kHalf = kSide / 2;
        const Index3 at{centre[0] + x - kHalf, centre[1] + y - kHalf, centre[2] + z - kHalf};
        const bool inside = image.frame.contains(at[0], at[1], at[2]) &&
                            image.voxels[image.frame.offset(at[0], at[1], at[2])] == material;
        row |= inside != complement ? 1U << static_cast<unsigned>(x) : 0U;
      }
      window[static_cast<std::size_t>(z)][static_cast<std::size_t>(y)] = row;
    }
  }
  return window;
}

// Combines every voxel with its 26 neighbours; rows at the window's border become empty.
template <class Combine>
Window combine_neighbours(const Window& window, const Combine& combine) {
  Window along_x{}, result{};
  for (std::size_t z = 0; z < kSide; ++z) {
    for (std::size_t y = 0; y < kSide; ++y) {
      const unsigned row = window[z][y];
      along_x[z][y] = combine(combine(row, row << 1U), row >> 1U);
    }
  }
  for (std::size_t z = 1; z + 1 < kSide; ++z) {
    for (std::size_t y = 1; y + 1 < kSide; ++y) {
      unsigned row = along_x[z][y];
      for (std::size_t n = 0; n < 9; ++n) {
        row = combine(row, along_x[z + n / 3 - 1][y + n % 3 - 1]);
      }
      result[z][y] = row;
    }
  }
  return result;
}

}  // namespace

bool is_thin_near(const LabelImage& image, const Index3& centre, MaterialId material, bool complement) {
  const Window set = load(image, centre, material, complement);
  const Window eroded = combine_neighbours(set, [](unsigned a, unsigned b) { return a & b; });
  const Window opened = combine_neighbours(eroded, [](unsigned a, unsigned b) { return a | b; });
  constexpr unsigned kNear = ((1U << static_cast<unsigned>(2 * kThinReach + 1)) - 1U) << kMargin;
  unsigned thin = 0;
  for (std::size_t z = kMargin; z + kMargin < kSide; ++z) {
    for (std::size_t y = kMargin; y + kMargin < kSide; ++y) {
      thin |= set[z][y] & ~opened[z][y] & kNear;
    }
  }
  return thin != 0;
}

}  // namespace cbc3d::metrics
