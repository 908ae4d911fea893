// The octree over the labels: leaves of one material each, balanced over faces and edges.
//
// Notation: level  a box of the octree at level n has 2^n cells along each edge; level 0 are the cells;
//           split  a box that consists of eight of the level below; a box that is not split, in one that is,
//                  is a leaf.
#pragma once

#include <cstdint>
#include <vector>

#include "baselines/ld/cell_grid.hpp"

namespace cbc3d::baselines::ld {

/// A leaf of the octree.
struct Leaf {
  int level = 0;
  Index3 low{};  ///< its lowest cell
};

/// The octree of a grid, one bit for each box of two cells or more: an eighth of a bit more than that for
/// every 8 cells. A box is split when it holds two materials, or when a box that shares a face or an edge
/// with it would otherwise have neighbours of less than half its size. That is decided from level to level
/// upwards, so one pass over the boxes suffices.
class LabelOctree {
 public:
  /// The largest leaves are blocks of the grid. Works in parallel; the result is the same at any thread
  /// count.
  explicit LabelOctree(const CellGrid& grid);

  /// Number of levels above the cells; boxes of the topmost are blocks.
  [[nodiscard]] int levels() const { return static_cast<int>(boxes_.size()); }
  /// True when a box is split. `box` counts boxes of that level; false for cells and outside the grid.
  [[nodiscard]] bool is_split(int level, const Index3& box) const {
    return level > 0 && boxes_[static_cast<std::size_t>(level - 1)].get(box);
  }
  /// Appends the leaves of a block, `block` counting blocks, in a fixed order.
  void append_leaves(const Index3& block, std::vector<Leaf>& leaves) const;

 private:
  // Bits of the boxes of a level, each row in words of its own.
  class Bits {
   public:
    explicit Bits(const Index3& size);
    [[nodiscard]] const Index3& size() const { return size_; }
    [[nodiscard]] std::size_t words_per_row() const { return words_; }
    [[nodiscard]] bool get(const Index3& box) const {
      for (std::size_t a = 0; a < 3; ++a) {
        if (box[a] < 0 || box[a] >= size_[a]) return false;
      }
      return (row(box[1], box[2])[static_cast<std::size_t>(box[0]) / 64] >> (box[0] & 63) & 1U) != 0;
    }
    [[nodiscard]] const std::uint64_t* row(int j, int k) const {
      return &bits_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) +
                     static_cast<std::size_t>(j)) *
                    words_];
    }
    std::uint64_t* row(int j, int k) { return const_cast<std::uint64_t*>(std::as_const(*this).row(j, k)); }

   private:
    Index3 size_;
    std::size_t words_;
    std::vector<std::uint64_t> bits_;
  };

  static void split_mixed_cells(const CellGrid& grid, Bits& level);
  static void balance(const Bits& below, Bits& level);
  static void split_mixed_boxes(const CellGrid& grid, int level_number, Bits& level);

  std::vector<Bits> boxes_;  // of level 1, 2, ...
};

/// The centre of a leaf.
LatticePoint centre_of(const Leaf& leaf);

}  // namespace cbc3d::baselines::ld
