#include "mesher/lattice/voxel_raster.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace cbc3d {
namespace {

/// Quotient rounded towards plus infinity; divisor > 0.
std::int64_t ceil_div(std::int64_t dividend, std::int64_t divisor) {
  if (divisor == 1) {  // most faces of a lattice
    return dividend;
  }
  const std::int64_t quotient = dividend / divisor;
  return quotient + static_cast<std::int64_t>(dividend % divisor > 0);
}

}  // namespace

VoxelRaster::VoxelRaster(const ImageFrame& image, const LatticeFrame& lattice, const Index3& parts) {
  const double scale = static_cast<double>(Fixed{1} << kFractionBits) / lattice.unit_mm;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    axes_[axis] = make_axis(image.size[axis], parts[axis], image.spacing_mm[d], lattice.origin_mm[d], scale);
  }
}

VoxelRaster::Axis VoxelRaster::make_axis(int size, int parts, double spacing_mm, double origin_mm,
                                         double scale) {
  Axis axis;
  axis.inverse_step = parts / (spacing_mm * scale);
  axis.centre.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < axis.centre.size(); ++i) {
    const double index = (static_cast<double>(i) + 0.5) / parts - 0.5;
    axis.centre[i] = std::llround((index * spacing_mm - origin_mm) * scale);
  }
  axis.first_unit = static_cast<std::int32_t>(axis.centre.front() >> kFractionBits) - 1;
  const auto last_unit = static_cast<std::int32_t>(axis.centre.back() >> kFractionBits) + 1;
  for (std::int32_t unit = axis.first_unit; unit <= last_unit; ++unit) {
    const Fixed position = static_cast<Fixed>(unit) << kFractionBits;
    axis.ends_of_unit.push_back({axis.first_at_or_after(position), axis.first_at_or_after(position + 1)});
  }
  return axis;
}

int VoxelRaster::Axis::first_at_or_after(Fixed position) const {
  const int size = static_cast<int>(centre.size());
  // The guess is mostly right; the loops correct it where rounding made it wrong.
  const double guess = static_cast<double>(position - centre[0]) * inverse_step + 1;
  int i = static_cast<int>(std::min(std::max(guess, 0.0), static_cast<double>(size)));
  while (i < size && centre[static_cast<std::size_t>(i)] < position) {
    ++i;
  }
  while (i > 0 && centre[static_cast<std::size_t>(i) - 1] >= position) {
    --i;
  }
  return i;
}

std::array<std::array<int, 2>, 3> VoxelRaster::voxels_in_box(const LatticePoint& low,
                                                             const LatticePoint& high) const {
  std::array<std::array<int, 2>, 3> range{};
  for (std::size_t d = 0; d < 3; ++d) {
    range[d] = {axes_[d].ends(low[d]).at_or_after, axes_[d].ends(high[d]).after};
  }
  return range;
}

VoxelRaster::HalfSpace VoxelRaster::half_space(const LatticePoint& a, const LatticePoint& b,
                                               const LatticePoint& c) {
  const std::array<Fixed, 3> u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const std::array<Fixed, 3> v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  HalfSpace side{};
  side.normal = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  // Lattice faces have normals of small integers times a power of two: without it, the products below stay
  // far from overflow.
  const auto bits = static_cast<std::uint64_t>(side.normal[0] | side.normal[1] | side.normal[2]);
  const int shift = bits == 0 ? 0 : std::countr_zero(bits);
  side.offset = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    side.normal[d] >>= shift;
    side.offset += side.normal[d] * (static_cast<Fixed>(a[d]) << kFractionBits);
  }
  return side;
}

std::array<VoxelRaster::HalfSpace, 4> VoxelRaster::half_spaces(const std::array<LatticePoint, 4>& t) {
  return {half_space(t[0], t[1], t[2]), half_space(t[0], t[2], t[3]), half_space(t[0], t[3], t[1]),
          half_space(t[1], t[3], t[2])};
}

bool VoxelRaster::clip_row(const std::array<HalfSpace, 4>& sides, Fixed y, Fixed z, Fixed& low, Fixed& high) {
  for (const HalfSpace& side : sides) {
    const auto& [nx, ny, nz] = side.normal;
    const Fixed rest =
        ny * y + nz * z - side.offset;  // inside: nx * x + rest > 0, or = 0 and shifted inwards
    if (nx > 0) {
      low = std::max(low, ceil_div(-rest, nx));  // the shift along +x is inwards: equality counts
    } else if (nx < 0) {
      high = std::min(high, ceil_div(rest, -nx));  // outwards: strictly less
    } else if (rest < 0 || (rest == 0 && !(ny > 0 || (ny == 0 && nz > 0)))) {
      return false;
    }
  }
  return low < high;
}

}  // namespace cbc3d
