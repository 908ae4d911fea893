#include "baselines/cleaver/octree.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines::cleaver {

Octree::Octree(const LatticeGrid& grid) : grid_(grid) {
  divided_.resize(static_cast<std::size_t>(grid.top_level) + 1);
  for (int level = 1; level <= grid.top_level; ++level) {
    divided_[static_cast<std::size_t>(level)] = CellArray<char>(grid.cells_of_level(level), 0);
  }
}

Octree Octree::uniform(const LatticeGrid& grid) {
  Octree octree(grid);
  for (int level = grid.usual_level + 1; level <= grid.top_level; ++level) {
    auto& values = octree.divided_[static_cast<std::size_t>(level)].values;
    std::fill(values.begin(), values.end(), char{1});
  }
  return octree;
}

Octree Octree::graded(const LatticeGrid& grid, const CellArray<float>& sizes,
                      const ImageIndicators& indicators) {
  Octree octree(grid);
  octree.divide_by_sizes(sizes);
  octree.divide_at_border(indicators);
  octree.balance();
  return octree;
}

void Octree::divide_by_sizes(const CellArray<float>& sizes) {
  CellArray<float> least = sizes;
  for (int level = grid_.usual_level + 1; level <= grid_.top_level; ++level) {
    auto& divided = divided_[static_cast<std::size_t>(level)];
    const auto edge = static_cast<float>(1 << (level - grid_.usual_level));
    for (std::size_t c = 0; c < least.values.size(); ++c) divided.values[c] = least.values[c] < edge ? 1 : 0;
    if (level == grid_.top_level) break;
    CellArray<float> coarser(grid_.cells_of_level(level + 1), 1e30F);
    for (int k = 0; k < least.size[2]; ++k) {
      for (int j = 0; j < least.size[1]; ++j) {
        for (int i = 0; i < least.size[0]; ++i) {
          float& value = coarser.at(i / 2, j / 2, k / 2);
          value = std::min(value, least.at(i, j, k));
        }
      }
    }
    least = std::move(coarser);
  }
}

void Octree::divide_at_border(const ImageIndicators& indicators) {
  for (int level = 1; level <= grid_.top_level; ++level) {
    auto& divided = divided_[static_cast<std::size_t>(level)];
    const int edge = 1 << level;
#pragma omp parallel for schedule(static)
    for (int k = 0; k < divided.size[2]; ++k) {
      for (int j = 0; j < divided.size[1]; ++j) {
        for (int i = 0; i < divided.size[0]; ++i) {
          const Vec3 low = grid_.place(i * edge, j * edge, k * edge);
          const Vec3 high = grid_.place((i + 1) * edge, (j + 1) * edge, (k + 1) * edge);
          bool across = false;
          for (int axis = 0; axis < 3; ++axis) {
            const double slack = 1e-6 * (high[axis] - low[axis]);
            for (const double side : {indicators.low()[axis], indicators.high()[axis]})
              across = across || (low[axis] < side - slack && high[axis] > side + slack);
          }
          // A grid cell itself may reach across; only larger ones are divided for it.
          if (across && level > grid_.usual_level && !indicators.is_surely_background(low, high))
            divided.at(i, j, k) = 1;
        }
      }
    }
  }
}

void Octree::divide_at(const std::vector<Index3>& grid_cells) {
  for (const Index3& cell : grid_cells) {
    for (int level = 1; level <= grid_.top_level; ++level)
      divided_[static_cast<std::size_t>(level)].at(cell[0] >> level, cell[1] >> level, cell[2] >> level) = 1;
  }
}

// From small to large: a divided cell's parent is divided, and so are the parents of its neighbours, so that
// these exist.
void Octree::balance() {
  for (int level = 1; level < grid_.top_level; ++level) {
    const auto& fine = divided_[static_cast<std::size_t>(level)];
    auto& coarse = divided_[static_cast<std::size_t>(level) + 1];
    for (int k = 0; k < fine.size[2]; ++k) {
      for (int j = 0; j < fine.size[1]; ++j) {
        for (int i = 0; i < fine.size[0]; ++i) {
          if (fine.at(i, j, k) == 0) continue;
          const Index3 low{std::max(0, i - 1) / 2, std::max(0, j - 1) / 2, std::max(0, k - 1) / 2};
          const Index3 high{std::min(fine.size[0] - 1, i + 1) / 2, std::min(fine.size[1] - 1, j + 1) / 2,
                            std::min(fine.size[2] - 1, k + 1) / 2};
          for (int z = low[2]; z <= high[2]; ++z) {
            for (int y = low[1]; y <= high[1]; ++y) {
              for (int x = low[0]; x <= high[0]; ++x) coarse.at(x, y, z) = 1;
            }
          }
        }
      }
    }
  }
}

int Octree::level_at(const Index3& grid_cell) const {
  Index3 c{};
  for (std::size_t a = 0; a < 3; ++a) c[a] = std::clamp(grid_cell[a], 0, grid_.cells[a] - 1);
  int level = 0;
  while (level < grid_.top_level && divided_[static_cast<std::size_t>(level) + 1].at(
                                        c[0] >> (level + 1), c[1] >> (level + 1), c[2] >> (level + 1)) == 0)
    ++level;
  return level;
}

// A leaf matters when a label may be in it or in the cells beside it, whose centres are within twice its
// size.
void Octree::append_leaves(const Index3& cell, int level, const ImageIndicators& indicators,
                           std::vector<Leaf>& leaves) const {
  const int edge = 1 << level;
  const double reach = 1.01 * edge;
  const Vec3 low = grid_.place(cell[0] - reach, cell[1] - reach, cell[2] - reach);
  const Vec3 high = grid_.place(cell[0] + edge + reach, cell[1] + edge + reach, cell[2] + edge + reach);
  if (indicators.is_surely_background(low, high)) return;
  if (level == 0 || divided_[static_cast<std::size_t>(level)].at(cell[0] >> level, cell[1] >> level,
                                                                 cell[2] >> level) == 0) {
    leaves.push_back({cell, level});
    return;
  }
  for (int child = 0; child < 8; ++child) {
    const int half = edge / 2;
    append_leaves(
        {cell[0] + (child & 1) * half, cell[1] + ((child >> 1) & 1) * half, cell[2] + (child >> 2) * half},
        level - 1, indicators, leaves);
  }
}

std::vector<Leaf> Octree::leaves_near_labels(const ImageIndicators& indicators) const {
  const Index3 tops = grid_.cells_of_level(grid_.top_level);
  const auto count = static_cast<std::size_t>(tops[0]) * static_cast<std::size_t>(tops[1]) *
                     static_cast<std::size_t>(tops[2]);
  std::vector<std::vector<Leaf>> of_top(count);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t t = 0; t < count; ++t) {
    const auto x = static_cast<std::size_t>(tops[0]), y = static_cast<std::size_t>(tops[1]);
    const Index3 at{static_cast<int>(t % x), static_cast<int>(t / x % y), static_cast<int>(t / x / y)};
    append_leaves({at[0] << grid_.top_level, at[1] << grid_.top_level, at[2] << grid_.top_level},
                  grid_.top_level, indicators, of_top[t]);
  }
  std::vector<Leaf> leaves;
  for (const auto& part : of_top) leaves.insert(leaves.end(), part.begin(), part.end());
  return leaves;
}

}  // namespace cbc3d::baselines::cleaver
