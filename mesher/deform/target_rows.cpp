#include "mesher/deform/target_rows.hpp"

#include <limits>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d {

TargetRows::TargetRows(const TargetPoints& targets, const ImageFrame& frame)
    : targets_(targets), frame_(frame), x_(static_cast<std::size_t>(frame.size[0])) {
  if (targets.targets.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw JobError("the image has " + std::to_string(targets.targets.size()) +
                   " target points, more than can be numbered; connectivity vertex takes fewer");
  }
  for (int i = 0; i < frame.size[0]; ++i) {
    x_[static_cast<std::size_t>(i)] = i * frame.spacing_mm.x;
  }
  // Blocks as short as they can be while the index takes no more memory than twice that of the targets.
  const std::size_t rows = targets.first.size() - 1;
  const auto blocks = [&] { return ((frame.size[0] - 1) >> block_bits_) + 1; };
  while (blocks() > 1 && rows * static_cast<std::size_t>(blocks() + 1) * sizeof(std::uint32_t) >
                             2 * targets.targets.size() * sizeof(TargetPoint)) {
    ++block_bits_;
  }
  block_count_ = blocks();
  begin_.resize(rows * static_cast<std::size_t>(block_count_ + 1));
#pragma omp parallel for schedule(static)
  for (int k = 0; k < frame.size[2]; ++k) {
    index_slice(k);
  }
}

void TargetRows::index_slice(int k) {
  const auto ny = static_cast<std::size_t>(frame_.size[1]);
  for (std::size_t j = 0; j < ny; ++j) {
    const std::size_t row = static_cast<std::size_t>(k) * ny + j;
    auto t = static_cast<std::uint32_t>(targets_.first[row]);
    const auto row_end = static_cast<std::uint32_t>(targets_.first[row + 1]);
    for (int b = 0; b <= block_count_; ++b) {
      while (t < row_end && targets_.targets[t].i >> block_bits_ < b) {
        ++t;
      }
      begin_[blocks_of(k, b) + j] = t;
    }
  }
}

Vec3 TargetRows::centre(std::uint32_t t) const {
  const auto row =
      static_cast<std::size_t>(std::upper_bound(targets_.first.begin(), targets_.first.end(), t) -
                               targets_.first.begin()) -
      1;
  const auto ny = static_cast<std::size_t>(frame_.size[1]);
  return frame_.local_centre(targets_.targets[t].i, static_cast<int>(row % ny), static_cast<int>(row / ny));
}

}  // namespace cbc3d
