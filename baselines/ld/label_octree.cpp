#include "baselines/ld/label_octree.hpp"

#include <utility>

namespace cbc3d::baselines::ld {

LabelOctree::Bits::Bits(const Index3& size)
    : size_(size),
      words_((static_cast<std::size_t>(size[0]) + 63) / 64),
      bits_(words_ * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2])) {}

LabelOctree::LabelOctree(const CellGrid& grid) {
  for (int side = 2; side <= grid.block(); side *= 2) {
    boxes_.emplace_back(Index3{grid.size()[0] / side, grid.size()[1] / side, grid.size()[2] / side});
    Bits& level = boxes_.back();
    if (side == 2) {
      split_mixed_cells(grid, level);
    } else {
      balance(boxes_[boxes_.size() - 2], level);
      split_mixed_boxes(grid, static_cast<int>(boxes_.size()), level);
    }
  }
}

void LabelOctree::split_mixed_cells(const CellGrid& grid, Bits& level) {
  const Index3& boxes = level.size();
  const auto row_size = static_cast<std::size_t>(grid.size()[0]);
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < boxes[2]; ++k) {
    std::array<std::vector<MaterialId>, 4> rows;
    for (auto& row : rows) row.resize(row_size);
    for (int j = 0; j < boxes[1]; ++j) {
      for (int r = 0; r < 4; ++r) {
        grid.read_row(0, grid.size()[0], 2 * j + r % 2, 2 * k + r / 2,
                      rows[static_cast<std::size_t>(r)].data());
      }
      std::uint64_t* bits = level.row(j, k);
      for (std::size_t i = 0; i < row_size / 2; ++i) {
        const MaterialId first = rows[0][2 * i];
        unsigned differs = first ^ rows[0][2 * i + 1];
        for (std::size_t r = 1; r < 4; ++r) {
          differs |= static_cast<unsigned>(first ^ rows[r][2 * i]) |
                     static_cast<unsigned>(first ^ rows[r][2 * i + 1]);
        }
        if (differs != 0) bits[i / 64] |= std::uint64_t{1} << (i % 64);
      }
    }
  }
}

namespace {

/// Bits 0, 2, 4, ... of a word, in its lower half.
std::uint64_t even_bits(std::uint64_t w) {
  w &= 0x5555555555555555U;
  w = (w | w >> 1U) & 0x3333333333333333U;
  w = (w | w >> 2U) & 0x0F0F0F0F0F0F0F0FU;
  w = (w | w >> 4U) & 0x00FF00FF00FF00FFU;
  w = (w | w >> 8U) & 0x0000FFFF0000FFFFU;
  return (w | w >> 16U) & 0x00000000FFFFFFFFU;
}

/// Every bit that is set, or beside one, along the row.
std::vector<std::uint64_t> widened(const std::vector<std::uint64_t>& row) {
  std::vector<std::uint64_t> wide(row.size());
  for (std::size_t w = 0; w < row.size(); ++w) {
    wide[w] = row[w] | row[w] << 1U | row[w] >> 1U;
    if (w > 0) wide[w] |= row[w - 1] >> 63U;
    if (w + 1 < row.size()) wide[w] |= row[w + 1] << 63U;
  }
  return wide;
}

}  // namespace

// A box is split when one of its eight parts is, or shares a face or an edge with a split box of its size.
void LabelOctree::balance(const Bits& below, Bits& level) {
  const Index3& boxes = level.size();
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < boxes[2]; ++k) {
    std::vector<std::uint64_t> near(below.words_per_row());
    std::vector<std::uint64_t> across_edge(below.words_per_row());
    for (int j = 0; j < boxes[1]; ++j) {
      std::fill(near.begin(), near.end(), 0);
      std::fill(across_edge.begin(), across_edge.end(), 0);
      for (int dk = -1; dk <= 2; ++dk) {
        for (int dj = -1; dj <= 2; ++dj) {
          const Index3 from{0, 2 * j + dj, 2 * k + dk};
          if (from[1] < 0 || from[2] < 0 || from[1] >= below.size()[1] || from[2] >= below.size()[2])
            continue;
          const bool is_off_both = (dj < 0 || dj > 1) && (dk < 0 || dk > 1);
          const std::uint64_t* row = below.row(from[1], from[2]);
          auto& sum = is_off_both ? across_edge : near;
          for (std::size_t w = 0; w < sum.size(); ++w) sum[w] |= row[w];
        }
      }
      const std::vector<std::uint64_t> wide = widened(near);
      std::uint64_t* bits = level.row(j, k);
      for (std::size_t w = 0; w < wide.size(); ++w) {
        const std::uint64_t parts = wide[w] | across_edge[w];
        bits[w / 2] |= even_bits(parts | parts >> 1U) << (w % 2 * 32);
      }
    }
  }
}

// No part of a box that is not split yet is split, so that its first cell tells the material of each.
void LabelOctree::split_mixed_boxes(const CellGrid& grid, int level_number, Bits& level) {
  const Index3& boxes = level.size();
  const int half = 1 << (level_number - 1);
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < boxes[2]; ++k) {
    for (int j = 0; j < boxes[1]; ++j) {
      for (int i = 0; i < boxes[0]; ++i) {
        if (level.get({i, j, k})) continue;
        const MaterialId first = grid.at(2 * half * i, 2 * half * j, 2 * half * k);
        bool is_mixed = false;
        for (int part = 1; part < 8 && !is_mixed; ++part) {
          is_mixed = first != grid.at(half * (2 * i + (part & 1)), half * (2 * j + (part >> 1 & 1)),
                                      half * (2 * k + (part >> 2)));
        }
        if (is_mixed) level.row(j, k)[i / 64] |= std::uint64_t{1} << (i % 64);
      }
    }
  }
}

void LabelOctree::append_leaves(const Index3& block, std::vector<Leaf>& leaves) const {
  struct Box {
    int level;
    Index3 at;  // counts boxes of the level
  };
  std::vector<Box> open{{levels(), block}};
  while (!open.empty()) {
    const Box box = open.back();
    open.pop_back();
    if (!is_split(box.level, box.at)) {
      leaves.push_back({box.level, {box.at[0] << box.level, box.at[1] << box.level, box.at[2] << box.level}});
      continue;
    }
    for (int part = 7; part >= 0; --part) {
      open.push_back(
          {box.level - 1,
           {2 * box.at[0] + (part & 1), 2 * box.at[1] + (part >> 1 & 1), 2 * box.at[2] + (part >> 2)}});
    }
  }
}

LatticePoint centre_of(const Leaf& leaf) {
  LatticePoint centre;
  for (std::size_t a = 0; a < 3; ++a) centre[a] = 2 * leaf.low[a] + (1 << leaf.level);
  return centre;
}

}  // namespace cbc3d::baselines::ld
