// Values of cells in a box of them, and a walk over it.
#pragma once

#include <cstddef>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines::cleaver {

/// A value for each cell, in the order of an image's voxels.
template <typename T>
struct CellArray {
  Index3 size{0, 0, 0};
  std::vector<T> values;

  CellArray() = default;
  CellArray(const Index3& cells, T value) : size(cells), values(frame().voxel_count(), value) {}
  [[nodiscard]] std::size_t offset(int i, int j, int k) const { return frame().offset(i, j, k); }
  [[nodiscard]] bool contains(int i, int j, int k) const { return frame().contains(i, j, k); }
  [[nodiscard]] T& at(int i, int j, int k) { return values[offset(i, j, k)]; }
  [[nodiscard]] const T& at(int i, int j, int k) const { return values[offset(i, j, k)]; }

 private:
  [[nodiscard]] ImageFrame frame() const { return {.size = size}; }
};

/// Calls visit(i, j, k) once for each cell; threads share the layers of cells.
template <typename Visit>
void for_each_cell(const Index3& size, const Visit& visit) {
#pragma omp parallel for schedule(static)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) visit(i, j, k);
    }
  }
}

}  // namespace cbc3d::baselines::cleaver
