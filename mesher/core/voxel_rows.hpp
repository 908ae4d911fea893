// Rows of voxels read eight bytes at a time: nearly all of an image is uniform and can be skipped that way.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// Voxels in eight bytes.
template <typename Voxel>
inline constexpr int kVoxelsInWord = static_cast<int>(sizeof(std::uint64_t) / sizeof(Voxel));

/// Eight bytes of voxels as one number.
template <typename Voxel>
std::uint64_t voxel_word(const Voxel* first) {
  std::uint64_t word = 0;
  std::memcpy(&word, first, sizeof word);
  return word;
}

/// Sixteen bytes of voxels in a register: compilers for x86-64 and ARM compare them in one instruction.
template <typename Voxel>
struct VoxelLanes {
  using Lanes [[gnu::vector_size(16)]] = Voxel;
  using Mask = decltype(Lanes{} == Lanes{});  // -1 or 0 by voxel
  static constexpr int kCount = static_cast<int>(sizeof(Lanes) / sizeof(Voxel));

  static Lanes load(const Voxel* first) {
    Lanes lanes;
    std::memcpy(&lanes, first, sizeof lanes);
    return lanes;
  }
  template <typename Any>
  static bool any(const Any& lanes) {
    static_assert(sizeof lanes == 16);
    std::uint64_t words[2];
    std::memcpy(words, &lanes, sizeof words);
    return (words[0] | words[1]) != 0;
  }
};

/// The first index in (i, end) whose voxel differs from voxel i; `end` when there is none.
template <typename Voxel>
int end_of_run(const Voxel* row, int i, int end) {
  constexpr int kStep = kVoxelsInWord<Voxel>;
  const Voxel value = row[i];
  ++i;
  if (i < end && row[i] != value) {
    return i;
  }
  const std::uint64_t uniform = value * (~std::uint64_t{0} / static_cast<Voxel>(~Voxel{0}));
  while (i + kStep <= end && voxel_word(row + i) == uniform) {
    i += kStep;
  }
  while (i < end && row[i] == value) {
    ++i;
  }
  return i;
}

/// True when the voxels begin ... end - 1 of a row are all `value`; begin < end.
template <typename Voxel>
bool is_all_of(const Voxel* row, int begin, int end, Voxel value) {
  constexpr int kStep = kVoxelsInWord<Voxel>;
  if (end - begin < kStep) {
    return std::all_of(row + begin, row + end, [value](Voxel v) { return v == value; });
  }
  const std::uint64_t uniform = value * (~std::uint64_t{0} / static_cast<Voxel>(~Voxel{0}));
  for (int i = begin; i < end - kStep; i += kStep) {
    if (voxel_word(row + i) != uniform) {
      return false;
    }
  }
  return voxel_word(row + end - kStep) == uniform;  // this word overlaps the last one
}

/// Finds the boundary voxels of the labelled materials, row by row. The outside of the image counts as
/// background.
class BoundaryRows {
 public:
  /// `image` must outlive this.
  explicit BoundaryRows(const LabelImage& image);
  /// Appends the index along x of every labelled boundary voxel (is_boundary_voxel) of row (j, k), ascending.
  void find(int j, int k, std::vector<int>& found) const;

 private:
  const LabelImage& image_;
  std::vector<std::uint16_t> none_;  // a row of background
};

}  // namespace cbc3d
