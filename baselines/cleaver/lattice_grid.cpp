#include "baselines/cleaver/lattice_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

constexpr int kLevelsAboveUsual = 6;
constexpr double kMostGridCells = 6e10;

struct VoxelBox {
  Index3 first{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
               std::numeric_limits<int>::max()};
  Index3 last{-1, -1, -1};

  void include(int i, int j, int k) {
    const Index3 at{i, j, k};
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = std::min(first[a], at[a]);
      last[a] = std::max(last[a], at[a]);
    }
  }
  void include(const VoxelBox& other) {
    for (std::size_t a = 0; a < 3; ++a) {
      first[a] = std::min(first[a], other.first[a]);
      last[a] = std::max(last[a], other.last[a]);
    }
  }
};

VoxelBox box_of_slice(const LabelImage& image, int k) {
  VoxelBox box;
  const Index3& size = image.frame.size;
  image.voxels.visit([&](const auto* voxels) {
    for (int j = 0; j < size[1]; ++j) {
      const auto* row = voxels + image.frame.offset(0, j, k);
      const auto* end = row + size[0];
      const auto* first = std::find_if(row, end, [](auto m) { return m != kBackground; });
      if (first == end) continue;
      int last = size[0] - 1;
      while (row[last] == kBackground) --last;
      box.include(static_cast<int>(first - row), j, k);
      box.include(last, j, k);
    }
  });
  return box;
}

VoxelBox box_of_labels(const LabelImage& image) {
  std::vector<VoxelBox> slices(static_cast<std::size_t>(image.frame.size[2]));
#pragma omp parallel for schedule(static)
  for (int k = 0; k < image.frame.size[2]; ++k) slices[static_cast<std::size_t>(k)] = box_of_slice(image, k);
  VoxelBox box;
  for (const VoxelBox& slice : slices) box.include(slice);
  return box;
}

bool touches_border(const VoxelBox& box, const Index3& size) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (box.first[a] == 0 || box.last[a] == size[a] - 1) return true;
  }
  return false;
}

// How often cells of size 1 are halved to become grid cells.
int halvings(const LabelImage& image, double cell_edge_mm) {
  const double least = image.frame.spacing_mm.min_coeff();
  int level = 0;
  while (cell_edge_mm / (1 << level) > 1.001 * least && level < 6) ++level;
  return level;
}

double cell_along(const LabelImage& image, int axis, double cell_edge_mm, bool fits_image) {
  if (!fits_image) return cell_edge_mm;
  const double length = image.frame.spacing_mm[axis] * image.frame.size[static_cast<std::size_t>(axis)];
  return length / std::max(1.0, std::round(length / cell_edge_mm));
}

// Cells of size 1 along an axis, with a margin beyond the labels.
struct AxisCells {
  double edge_mm;   // of a cell of size 1
  double first_mm;  // the lower side of the first one
  double count;     // a multiple of those in the largest cells
};

AxisCells cells_over(const LabelImage& image, const VoxelBox& box, int axis, double edge_mm) {
  const auto a = static_cast<std::size_t>(axis);
  const double spacing = image.frame.spacing_mm[axis];
  // Two cells and three voxels beyond the labels all is background, whatever is blurred by default.
  const double border = -0.5 * spacing;
  const double margin = 2 * edge_mm + 3 * spacing;
  const double first = std::floor(((box.first[a] - 0.5) * spacing - margin - border) / edge_mm);
  const double last = std::ceil(((box.last[a] + 0.5) * spacing + margin - border) / edge_mm);
  const double top = 1 << kLevelsAboveUsual;
  return {edge_mm, border + first * edge_mm, std::ceil((last - first) / top) * top};
}

}  // namespace

LatticeGrid grid_over_labels(const LabelImage& image, double cell_edge_mm) {
  const VoxelBox box = box_of_labels(image);
  if (box.last[0] < 0)
    throw InputError("the image has no label: every voxel is background; give a segmentation");
  LatticeGrid grid;
  grid.usual_level = halvings(image, cell_edge_mm);
  grid.top_level = grid.usual_level + kLevelsAboveUsual;
  const bool fits_image = touches_border(box, image.frame.size);
  double total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisCells along = cells_over(image, box, axis, cell_along(image, axis, cell_edge_mm, fits_image));
    grid.origin_mm[axis] = along.first_mm;
    grid.cell_mm[axis] = along.edge_mm / (1 << grid.usual_level);
    const double cells = along.count * (1 << grid.usual_level);
    total *= cells;
    if (cells > 1e6 || total > kMostGridCells) {
      throw JobError(
          "the lattice's grid would have more than 1e6 cells along an axis or 6e10 in all: lower "
          "--sampling-rate");
    }
    grid.cells[static_cast<std::size_t>(axis)] = static_cast<int>(cells);
  }
  return grid;
}

}  // namespace cbc3d::baselines::cleaver
