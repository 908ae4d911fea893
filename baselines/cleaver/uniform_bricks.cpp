#include "baselines/cleaver/uniform_bricks.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines::cleaver {
namespace {

constexpr int kBrick = UniformBricks::kBrick;
constexpr std::uint32_t kMixed = UniformBricks::kMixed;

Index3 brick_counts(const Index3& voxels) {
  Index3 counts{};
  for (std::size_t a = 0; a < 3; ++a) counts[a] = (voxels[a] + kBrick - 1) / kBrick;
  return counts;
}

// The only material of the brick whose lowest voxel is `first`, or kMixed.
template <typename Voxel>
std::uint32_t material_of_brick(const Voxel* voxels, const ImageFrame& frame, const Index3& first) {
  Index3 end{};
  for (std::size_t a = 0; a < 3; ++a) end[a] = std::min(first[a] + kBrick, frame.size[a]);
  const Voxel material = voxels[frame.offset(first[0], first[1], first[2])];
  for (int k = first[2]; k < end[2]; ++k) {
    for (int j = first[1]; j < end[1]; ++j) {
      const Voxel* row = voxels + frame.offset(first[0], j, k);
      const auto differs = [&](Voxel voxel) { return voxel != material; };
      if (std::any_of(row, row + (end[0] - first[0]), differs)) return kMixed;
    }
  }
  return material;
}

}  // namespace

UniformBricks::UniformBricks(const LabelImage& image, const Vec3& reach_voxels)
    : frame_(image.frame), bricks_(brick_counts(image.frame.size), kMixed) {
  take_own_materials(image);
  for (int axis = 0; axis < 3; ++axis) {
    // A place belongs to a brick's voxels by half a voxel more than their centres.
    const int around = static_cast<int>(std::ceil((reach_voxels[axis] + 0.5) / kBrick));
    mix_with_neighbours(static_cast<std::size_t>(axis), around);
  }
}

void UniformBricks::take_own_materials(const LabelImage& image) {
  image.voxels.visit([&](const auto* voxels) {
    for_each_cell(bricks_.size, [&](int i, int j, int k) {
      bricks_.at(i, j, k) = material_of_brick(voxels, frame_, {i * kBrick, j * kBrick, k * kBrick});
    });
  });
}

// A brick is mixed when one of its neighbours along the axis differs from it.
void UniformBricks::mix_with_neighbours(std::size_t axis, int around) {
  const CellArray<std::uint32_t> before = bricks_;
  for_each_cell(bricks_.size, [&](int i, int j, int k) {
    std::uint32_t& found = bricks_.at(i, j, k);
    Index3 at{i, j, k};
    const int here = at[axis];
    const int last = std::min(bricks_.size[axis] - 1, here + around);
    for (int n = std::max(0, here - around); n <= last && found != kMixed; ++n) {
      at[axis] = n;
      if (before.at(at[0], at[1], at[2]) != found) found = kMixed;
    }
  });
}

Index3 UniformBricks::brick_of(const Vec3& place) const {
  Index3 brick{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double voxel = std::floor(place[axis] / frame_.spacing_mm[axis] + 0.5);
    brick[a] = static_cast<int>(std::clamp(voxel, 0.0, frame_.size[a] - 1.0)) / kBrick;
  }
  return brick;
}

std::uint32_t UniformBricks::at(const Vec3& place) const {
  const Index3 brick = brick_of(place);
  return bricks_.at(brick[0], brick[1], brick[2]);
}

bool UniformBricks::are_background(const Vec3& low, const Vec3& high) const {
  const Index3 first = brick_of(low), last = brick_of(high);
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        if (bricks_.at(i, j, k) != kBackground) return false;
      }
    }
  }
  return true;
}

}  // namespace cbc3d::baselines::cleaver
