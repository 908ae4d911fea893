// The targets of an image made ready to be searched: what is near a place, found without a search of the
// rows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/deform/deformation_points.hpp"

namespace cbc3d {

/// Targets near a place, in raster order. One a thread: its memory is used again from search to search.
struct NearTargets {
  struct Row {
    double y, z;  ///< from the place to the row
  };
  struct Hit {
    std::uint32_t target;
    std::uint32_t row;  ///< in `rows`
  };
  Vec3 place;
  std::vector<Row> rows;
  std::vector<Hit> hits;
  std::size_t count = 0;  ///< hits[0, count) are it
};

/// Rows of targets cut in blocks of voxels, with the place where each block begins. A ball asks for a few
/// voxels of a hundred rows, each with a handful of targets, if any: finding them by a search of the row took
/// longer than all that is done with them.
class TargetRows {
 public:
  /// Both must outlive this.
  TargetRows(const TargetPoints& targets, const ImageFrame& frame);

  /// Finds the targets that keep(target) holds for and whose voxel's centre is in the ball.
  template <typename Keep>
  void find(const Vec3& place, double radius, const Keep& keep, NearTargets& near) const;

  [[nodiscard]] const TargetPoint& target(std::uint32_t t) const { return targets_.targets[t]; }
  /// From the place to the voxel's centre of a hit.
  [[nodiscard]] Vec3 to_centre(const NearTargets& near, const NearTargets::Hit& hit) const {
    const auto i = static_cast<std::size_t>(target(hit.target).i);
    return {x_[i] - near.place.x, near.rows[hit.row].y, near.rows[hit.row].z};
  }
  /// The centre of a target's voxel, local mm. Looks for the row: for a few.
  [[nodiscard]] Vec3 centre(std::uint32_t t) const;

 private:
  struct Range {
    int first, last;
  };
  /// The voxels of an axis between place - radius and place + radius.
  [[nodiscard]] Range range(int axis, double place, double radius) const {
    const double spacing = frame_.spacing_mm[axis];
    const int size = frame_.size[static_cast<std::size_t>(axis)];
    return {std::max(0, static_cast<int>(std::ceil((place - radius) / spacing))),
            std::min(size - 1, static_cast<int>(std::floor((place + radius) / spacing)))};
  }
  /// Where block b of every row of slice k begins, by j; block block_count_ begins at the row's end.
  [[nodiscard]] std::size_t blocks_of(int k, int b) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(block_count_ + 1) +
            static_cast<std::size_t>(b)) *
           static_cast<std::size_t>(frame_.size[1]);
  }
  void index_slice(int k);

  const TargetPoints& targets_;
  const ImageFrame& frame_;
  std::vector<double> x_;  // centres along a row
  int block_bits_ = 3;     // voxels in a block: 1 << block_bits_
  int block_count_ = 0;    // in a row
  std::vector<std::uint32_t> begin_;
};

template <typename Keep>
void TargetRows::find(const Vec3& place, double radius, const Keep& keep, NearTargets& near) const {
  near.place = place;
  near.rows.clear();
  near.count = 0;
  const Range i = range(0, place.x, radius);
  const Range j_range = range(1, place.y, radius);
  const Range k_range = range(2, place.z, radius);
  if (i.first > i.last) {
    return;
  }
  const auto i_span = static_cast<unsigned>(i.last - i.first);
  const TargetPoint* const targets = targets_.targets.data();
  const double* const centres = x_.data();
  std::size_t count = 0;
  for (int k = k_range.first; k <= k_range.last; ++k) {
    const double z = k * frame_.spacing_mm.z - place.z;
    const double left_z = radius * radius - z * z;
    const std::uint32_t* const begin = begin_.data() + blocks_of(k, i.first >> block_bits_);
    const std::uint32_t* const end = begin_.data() + blocks_of(k, (i.last >> block_bits_) + 1);
    for (int j = j_range.first; j <= j_range.last; ++j) {
      const double y = j * frame_.spacing_mm.y - place.y;
      const double left = left_z - y * y;
      const std::uint32_t row_begin = begin[j];
      const std::uint32_t row_end = end[j];
      if (left < 0 || row_begin == row_end) {
        continue;
      }
      if (near.hits.size() < count + (row_end - row_begin)) {
        near.hits.resize(2 * (count + (row_end - row_begin)));
      }
      const auto row = static_cast<std::uint32_t>(near.rows.size());
      near.rows.push_back({y, z});
      // Without branches, for none of them could be foretold: a hit is written, and counts or is written
      // over.
      NearTargets::Hit* const hits = near.hits.data();
      for (std::uint32_t t = row_begin; t < row_end; ++t) {
        const double x = centres[targets[t].i] - place.x;
        hits[count] = {t, row};
        count += static_cast<std::size_t>(x * x <= left) &
                 static_cast<std::size_t>(static_cast<unsigned>(targets[t].i - i.first) <= i_span) &
                 static_cast<std::size_t>(keep(targets[t]));
      }
    }
  }
  near.count = count;
}

}  // namespace cbc3d
