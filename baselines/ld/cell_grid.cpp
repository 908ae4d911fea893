#include "baselines/ld/cell_grid.hpp"

#include <algorithm>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::ld {

std::int64_t orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                         const LatticePoint& d) {
  std::array<std::array<std::int64_t, 3>, 3> e{};
  const std::array<const LatticePoint*, 3> ends{&b, &c, &d};
  for (std::size_t n = 0; n < 3; ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) e[n][axis] = std::int64_t{(*ends[n])[axis]} - a[axis];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

CellGrid::CellGrid(const LabelImage& image, const CellGridOptions& options)
    : image_(&image), options_(options), size_(), cell_mm_() {
  constexpr std::int64_t kMostCells = std::int64_t{1} << 18U;  // half cells stay below 2^19
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const std::int64_t cells = std::int64_t{image.frame.size[a]} * options.pieces[a] + 2 * options.margin;
    if (cells > kMostCells - options.block) {
      throw InputError("the image has " + std::to_string(cells) + " cells along an axis, " +
                       std::to_string(options.pieces[a]) + " to a voxel; give an image of at most " +
                       std::to_string(kMostCells - options.block));
    }
    size_[a] = static_cast<int>((cells + options.block - 1) / options.block * options.block);
    cell_mm_[axis] = image.frame.spacing_mm[axis] / options.pieces[a];
  }
}

void CellGrid::read_row(int begin, int end, int j, int k, MaterialId* materials) const {
  const ImageFrame& frame = image_->frame;
  const Index3 row{0, voxel_of(j, 1), voxel_of(k, 2)};
  if (!frame.contains(row[0], row[1], row[2])) {
    std::fill(materials, materials + (end - begin), kBackground);
    return;
  }
  const int pieces = options_.pieces[0];
  const int first = std::clamp(options_.margin, begin, end);
  const int last = std::clamp(options_.margin + frame.size[0] * pieces, first, end);
  std::fill(materials, materials + (first - begin), kBackground);
  image_->voxels.visit([&](const auto* voxels) {
    const auto* from = voxels + frame.offset(0, row[1], row[2]);
    if (pieces == 1) {
      std::copy(from + (first - options_.margin), from + (last - options_.margin),
                materials + (first - begin));
      return;
    }
    for (int i = first; i < last; ++i) materials[i - begin] = from[(i - options_.margin) / pieces];
  });
  std::fill(materials + (last - begin), materials + (end - begin), kBackground);
}

Vec3 CellGrid::local_mm(const LatticePoint& point) const {
  Vec3 place;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = 0.5 * point[static_cast<std::size_t>(axis)] - options_.margin;
    place[axis] = cells * cell_mm_[axis] - 0.5 * image_->frame.spacing_mm[axis];
  }
  return place;
}

}  // namespace cbc3d::baselines::ld
