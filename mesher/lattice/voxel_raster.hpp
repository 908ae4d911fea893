// Exact enumeration of the voxels whose centres lie in a lattice tet.
//
// Voxel centres are rounded once to a fixed-point grid of 2^-16 lattice units; from there on all arithmetic
// is in integers. A centre that falls on a face, edge or vertex is decided by the same infinitesimal shift
// (e, e^2, e^3) for every tet, so each voxel belongs to exactly one tet of a conforming mesh.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/lattice/lattice.hpp"

namespace cbc3d {

class VoxelRaster {
 public:
  /// With `parts` above 1 the voxels of an image that is so many times as fine along each axis.
  VoxelRaster(const ImageFrame& image, const LatticeFrame& lattice, const Index3& parts = {1, 1, 1});

  /// Calls row(j, k, i_begin, i_end) for every run of voxels inside the positively oriented tet. A row that
  /// returns true ends it.
  template <typename Row>
  void for_each_row(const std::array<LatticePoint, 4>& tet, Row&& row) const;

  /// The voxels whose centres lie in the box, upper sides included: begin and end of the indices by axis.
  [[nodiscard]] std::array<std::array<int, 2>, 3> voxels_in_box(const LatticePoint& low,
                                                                const LatticePoint& high) const;

 private:
  using Fixed = std::int64_t;
  static constexpr int kFractionBits = 16;

  /// Inward half-space n . x >= offset of a face (strictly where the infinitesimal shift says so).
  struct HalfSpace {
    std::array<Fixed, 3> normal;
    Fixed offset;
  };

  /// An axis of the image: fixed-point positions of the voxel centres.
  struct Axis {
    std::vector<Fixed> centre;
    /// First index whose centre is >= position (size when there is none).
    [[nodiscard]] int first_at_or_after(Fixed position) const;
    double inverse_step = 1;

    /// The first indices whose centres are >= a lattice coordinate, and > it.
    struct Ends {
      int at_or_after, after;
    };
    std::vector<Ends>
        ends_of_unit;  ///< from coordinate first_unit on; what lies outside is as its last or first
    std::int32_t first_unit = 0;
    [[nodiscard]] const Ends& ends(std::int32_t unit) const {
      const auto last = static_cast<std::int32_t>(ends_of_unit.size()) - 1;
      return ends_of_unit[static_cast<std::size_t>(std::clamp(unit - first_unit, 0, last))];
    }
  };

  static Axis make_axis(int size, int parts, double spacing_mm, double origin_mm, double scale);

  template <typename Row>
  static bool ends(Row& row, int j, int k, int i_begin, int i_end) {
    if constexpr (std::is_same_v<std::invoke_result_t<Row&, int, int, int, int>, bool>) {
      return row(j, k, i_begin, i_end);
    } else {
      row(j, k, i_begin, i_end);
      return false;
    }
  }
  static HalfSpace half_space(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
  static std::array<HalfSpace, 4> half_spaces(const std::array<LatticePoint, 4>& tet);
  /// Narrows [low, high) in fixed-point x; returns false when the row is empty.
  static bool clip_row(const std::array<HalfSpace, 4>& sides, Fixed y, Fixed z, Fixed& low, Fixed& high);

  std::array<Axis, 3> axes_;
};

template <typename Row>
void VoxelRaster::for_each_row(const std::array<LatticePoint, 4>& tet, Row&& row) const {
  LatticePoint low = tet[0];
  LatticePoint high = tet[0];
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t n = 1; n < 4; ++n) {
      low[d] = std::min(low[d], tet[n][d]);
      high[d] = std::max(high[d], tet[n][d]);
    }
  }
  const auto box = voxels_in_box(low, high);
  if (std::any_of(box.begin(), box.end(), [](const auto& range) { return range[0] >= range[1]; })) {
    return;
  }
  const std::array<HalfSpace, 4> sides = half_spaces(tet);
  for (int k = box[2][0]; k < box[2][1]; ++k) {
    for (int j = box[1][0]; j < box[1][1]; ++j) {
      Fixed x_low = static_cast<Fixed>(low[0]) << kFractionBits;
      Fixed x_high = (static_cast<Fixed>(high[0]) << kFractionBits) + 1;
      if (clip_row(sides, axes_[1].centre[static_cast<std::size_t>(j)],
                   axes_[2].centre[static_cast<std::size_t>(k)], x_low, x_high)) {
        const int i_begin = axes_[0].first_at_or_after(x_low);
        const int i_end = axes_[0].first_at_or_after(x_high);
        if (i_begin < i_end && ends(row, j, k, i_begin, i_end)) {
          return;
        }
      }
    }
  }
}

}  // namespace cbc3d
