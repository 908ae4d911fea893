#include "mesher/lattice/bcc_lattice.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/voxel_rows.hpp"
#include "mesher/lattice/voxel_raster.hpp"

namespace cbc3d {
namespace {

constexpr int kCoordinateBits = 21;

struct Box {
  std::array<int, 3> low{std::numeric_limits<int>::max(), std::numeric_limits<int>::max(),
                         std::numeric_limits<int>::max()};
  std::array<int, 3> high{-1, -1, -1};
  void add(int d, int low_index, int high_index) {
    const auto axis = static_cast<std::size_t>(d);
    low[axis] = std::min(low[axis], low_index);
    high[axis] = std::max(high[axis], high_index);
  }
};

/// Adds a row's labelled voxels to a box. Of a row within the box only what sticks out along x is looked at.
template <typename Voxel>
void add_row(const Voxel* row, int size, int j, int k, Box& box) {
  const auto first_labelled = [&](int begin, int end) {
    return begin >= end || row[begin] != kBackground ? begin : end_of_run(row, begin, end);
  };
  const bool known = box.low[1] <= j && j <= box.high[1] && box.low[2] <= k && k <= box.high[2];
  const int before = known ? box.low[0] : size;
  const int first = first_labelled(0, before);
  if (first == before && !known) {
    return;
  }
  box.add(0, first, first);
  box.add(1, j, j);
  box.add(2, k, k);
  for (int i = box.high[0] + 1; (i = first_labelled(i, size)) < size; ++i) {
    box.add(0, i, i);
  }
}

Box labelled_box(const LabelImage& image) {
  Box box;
  const auto& size = image.frame.size;
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel
    {
      Box mine;
#pragma omp for collapse(2) nowait
      for (int k = 0; k < size[2]; ++k) {
        for (int j = 0; j < size[1]; ++j) {
          add_row(voxels + image.frame.offset(0, j, k), size[0], j, k, mine);
        }
      }
#pragma omp critical(cbc3d_labelled_box)
      for (int d = 0; d < 3; ++d) {
        box.add(d, mine.low[static_cast<std::size_t>(d)], mine.high[static_cast<std::size_t>(d)]);
      }
    }
  });
  return box;
}

struct Grid {
  std::array<int, 3> cells{};
  LatticeFrame frame;
  int cell_units = 2;
};

/// Two layers of cells more than the box needs on every side (room for the tets around those that hold
/// labelled voxels), the whole centred on it, so that a symmetric object gets a symmetric lattice.
Grid make_grid(const LabelImage& image, const BccLatticeOptions& options) {
  const Box box = labelled_box(image);
  Grid grid;
  const double levels =
      std::floor(std::log2(std::max(1.0, options.spacing_mm / options.finest_spacing_mm)) + 1e-9);
  int most_cells = 0;
  std::array<double, 3> centre{};
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    const double extent = (box.high[axis] - box.low[axis] + 1) * image.frame.spacing_mm[d];
    centre[axis] = 0.5 * (box.high[axis] + box.low[axis]) * image.frame.spacing_mm[d];
    const double needed = std::ceil(extent / options.spacing_mm) + 4;
    if (needed * 2 >= static_cast<double>(1 << kCoordinateBits)) {
      std::ostringstream text;
      text << "lattice_spacing_mm " << options.spacing_mm << " is too small for this image; give at least "
           << extent / 1e5 << " mm";
      throw InputError(text.str(), "lattice_spacing_mm");
    }
    grid.cells[axis] = static_cast<int>(needed);
    most_cells = std::max(most_cells, grid.cells[axis]);
  }
  int max_level = static_cast<int>(std::min(levels, 20.0));
  while (max_level > 0 &&
         static_cast<std::int64_t>(most_cells) << (max_level + 1) >= (1 << kCoordinateBits)) {
    --max_level;
  }
  grid.cell_units = 2 << max_level;
  grid.frame.max_level = max_level;
  grid.frame.unit_mm = options.spacing_mm / grid.cell_units;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    grid.frame.origin_mm[d] = centre[axis] - 0.5 * grid.cells[axis] * options.spacing_mm;
  }
  return grid;
}

using PointTet = std::array<LatticePoint, 4>;

/// The four tets between the cell at `cell` and its neighbour along `axis`: the segment of the two cell
/// centres with each edge of the face between them.
std::array<PointTet, 4> tets_across_face(const Grid& grid, const Index3& cell, std::size_t axis) {
  const int s = grid.cell_units;
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  LatticePoint centre{};
  for (std::size_t d = 0; d < 3; ++d) {
    centre[d] = cell[d] * s + s / 2;
  }
  LatticePoint next = centre;
  next[axis] += s;
  LatticePoint corner = centre;
  corner[axis] += s / 2;
  const int h = s / 2;
  const std::array<std::array<int, 2>, 4> ring = {
      {{-h, -h}, {h, -h}, {h, h}, {-h, h}}};  // counter-clockwise about +axis
  std::array<PointTet, 4> tets;
  for (std::size_t e = 0; e < 4; ++e) {
    LatticePoint first = corner;
    LatticePoint second = corner;
    first[u] += ring[e][0];
    first[v] += ring[e][1];
    second[u] += ring[(e + 1) % 4][0];
    second[v] += ring[(e + 1) % 4][1];
    tets[e] = {centre, next, first, second};
  }
  return tets;
}

/// Which blocks of voxels hold a labelled one.
class OccupiedBlocks {
 public:
  explicit OccupiedBlocks(const LabelImage& image) {
    const auto& size = image.frame.size;
    for (std::size_t d = 0; d < 3; ++d) {
      count_[d] = (size[d] + kSide - 1) / kSide;
    }
    occupied_.assign(index(0, 0, count_[2]), 0);
    image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel for schedule(static)
      for (int layer = 0; layer < count_[2]; ++layer) {
        for (int k = layer * kSide; k < std::min(size[2], (layer + 1) * kSide); ++k) {
          for (int j = 0; j < size[1]; ++j) {
            mark_row(voxels + image.frame.offset(0, j, k), size[0], index(0, j / kSide, layer));
          }
        }
      }
    });
  }

  [[nodiscard]] bool any_in(const std::array<std::array<int, 2>, 3>& voxels) const {
    const auto& [x, y, z] = voxels;
    if (x[0] >= x[1] || y[0] >= y[1] || z[0] >= z[1]) {
      return false;
    }
    for (int k = z[0] / kSide; k <= (z[1] - 1) / kSide; ++k) {
      for (int j = y[0] / kSide; j <= (y[1] - 1) / kSide; ++j) {
        for (int i = x[0] / kSide; i <= (x[1] - 1) / kSide; ++i) {
          if (occupied_[index(i, j, k)] != 0) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  static constexpr int kSide = 8;

  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(count_[0]) +
           static_cast<std::size_t>(i);
  }

  template <typename Voxel>
  void mark_row(const Voxel* row, int size, std::size_t first_block) {
    for (int i = 0; i < size;) {
      if (row[i] == kBackground) {
        i = end_of_run(row, i, size);
      } else {
        occupied_[first_block + static_cast<std::size_t>(i / kSide)] = 1;
        i = (i / kSide + 1) * kSide;
      }
    }
  }

  std::array<int, 3> count_{};
  std::vector<std::uint8_t> occupied_;
};

bool holds_labelled_voxel(const LabelImage& image, const VoxelRaster& raster, const PointTet& tet) {
  bool found = false;
  raster.for_each_row(tet, [&](int j, int k, int i_begin, int i_end) {
    found = image.voxels.visit([&](const auto* voxels) {
      const auto* row = voxels + image.frame.offset(0, j, k);
      return row[i_begin] != kBackground || end_of_run(row, i_begin, i_end) < i_end;
    });
    return found;
  });
  return found;
}

/// Numbers for what may be a node: the centres of the cells, and their corners.
class NodeGrid {
 public:
  explicit NodeGrid(const Grid& grid)
      : cells_{grid.cells, {}, {}, Mat3::identity()},
        corners_{{grid.cells[0] + 1, grid.cells[1] + 1, grid.cells[2] + 1}, {}, {}, Mat3::identity()},
        shift_(std::countr_zero(static_cast<unsigned>(grid.cell_units))) {}

  [[nodiscard]] std::size_t size() const { return cells_.voxel_count() + corners_.voxel_count(); }
  [[nodiscard]] std::size_t number_of(const LatticePoint& node) const {
    const bool is_corner = (node[0] & ((1 << shift_) - 1)) == 0;
    const ImageFrame& frame = is_corner ? corners_ : cells_;
    return frame.offset(node[0] >> shift_, node[1] >> shift_, node[2] >> shift_) +
           (is_corner ? cells_.voxel_count() : 0);
  }

  /// True when a node of the tets between this cell and the next ones up is flagged.
  [[nodiscard]] bool has_flagged_node(const std::vector<std::uint8_t>& flags, const Index3& cell) const {
    unsigned found = flags[cells_.offset(cell[0], cell[1], cell[2])];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Index3 next = cell;
      if (++next[axis] < cells_.size[axis]) {
        found |= flags[cells_.offset(next[0], next[1], next[2])];
      }
    }
    for (int corner = 1; corner < 8; ++corner) {
      const std::size_t c =
          corners_.offset(cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2));
      found |= flags[cells_.voxel_count() + c];
    }
    return found != 0;
  }

 private:
  ImageFrame cells_, corners_;
  int shift_;
};

/// Reads and sets a flag; several threads may set the same one.
bool is_set(std::uint8_t& flag) {
  return std::atomic_ref<std::uint8_t>(flag).load(std::memory_order_relaxed) != 0;
}
void set_flag(std::uint8_t& flag) {
  std::atomic_ref<std::uint8_t>(flag).store(1, std::memory_order_relaxed);
}

/// Which of the 12 tets of a cell (4 a face, 3 upper faces) are wanted: bit 4 * axis + edge.
template <typename Wanted>
std::uint16_t select_tets(const Grid& grid, const Index3& cell, const Wanted& wanted) {
  unsigned bits = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell[axis] + 1 < grid.cells[axis]) {
      const auto tets = tets_across_face(grid, cell, axis);
      for (unsigned e = 0; e < 4; ++e) {
        bits |= wanted(tets[e]) ? 1U << (4 * static_cast<unsigned>(axis) + e) : 0U;
      }
    }
  }
  return static_cast<std::uint16_t>(bits);
}

/// Calls visit(number, cell) for the cells of a layer, ascending.
template <typename Visit>
void for_each_cell(const Grid& grid, int layer, const Visit& visit) {
  const ImageFrame cells{grid.cells, {}, {}, Mat3::identity()};
  std::size_t c = cells.offset(0, 0, layer);
  for (int j = 0; j < grid.cells[1]; ++j) {
    for (int i = 0; i < grid.cells[0]; ++i) {
      visit(c++, Index3{i, j, layer});
    }
  }
}

/// select_tets for every cell that may have a wanted tet, in parallel.
template <typename MayHave, typename Wanted>
std::vector<std::uint16_t> select_everywhere(const Grid& grid, const MayHave& may_have,
                                             const Wanted& wanted) {
  const ImageFrame cells{grid.cells, {}, {}, Mat3::identity()};
  std::vector<std::uint16_t> bits(cells.voxel_count(), 0);
#pragma omp parallel for schedule(dynamic)
  for (int layer = 0; layer < grid.cells[2]; ++layer) {
    for_each_cell(grid, layer, [&](std::size_t c, const Index3& cell) {
      bits[c] = may_have(cell) ? select_tets(grid, cell, wanted) : std::uint16_t{0};
    });
  }
  return bits;
}

/// A flag for every node of a tet that holds a labelled voxel.
std::vector<std::uint8_t> labelled_nodes(const LabelImage& image, const Grid& grid, const NodeGrid& nodes) {
  const VoxelRaster raster(image.frame, grid.frame);
  const OccupiedBlocks blocks(image);
  std::vector<std::uint8_t> labelled(nodes.size(), 0);
  // A cell's tets lie in it and in the next ones up.
  const auto may_have = [&](const Index3& cell) {
    const int s = grid.cell_units;
    return blocks.any_in(
        raster.voxels_in_box({cell[0] * s, cell[1] * s, cell[2] * s},
                             {cell[0] * s + 2 * s, cell[1] * s + 2 * s, cell[2] * s + 2 * s}));
  };
  select_everywhere(grid, may_have, [&](const PointTet& tet) {
    std::array<std::size_t, 4> numbers{};
    std::transform(tet.begin(), tet.end(), numbers.begin(),
                   [&](const LatticePoint& node) { return nodes.number_of(node); });
    // Where all are flagged already, by a few of the two dozen tets around each, the voxels need not be
    // asked.
    const bool known =
        std::all_of(numbers.begin(), numbers.end(), [&](std::size_t n) { return is_set(labelled[n]); });
    if (!known && holds_labelled_voxel(image, raster, tet)) {
      std::for_each(numbers.begin(), numbers.end(), [&](std::size_t n) { set_flag(labelled[n]); });
    }
    return false;
  });
  return labelled;
}

/// Calls action(tet) for the chosen tets, in the order of the cells.
template <typename Action>
void for_each_chosen(const Grid& grid, const std::vector<std::uint16_t>& chosen, const Action& action) {
  for (int layer = 0; layer < grid.cells[2]; ++layer) {
    for_each_cell(grid, layer, [&](std::size_t c, const Index3& cell) {
      for (unsigned axis = 0; axis < 3 && chosen[c] != 0; ++axis) {
        const auto tets = tets_across_face(grid, cell, axis);
        for (unsigned e = 0; e < 4; ++e) {
          if ((chosen[c] >> (4 * axis + e) & 1U) != 0) {
            action(tets[e]);
          }
        }
      }
    });
  }
}

}  // namespace

Lattice build_bcc_lattice(const LabelImage& image, const BccLatticeOptions& options) {
  const Grid grid = make_grid(image, options);
  const NodeGrid nodes(grid);
  const std::vector<std::uint8_t> labelled = labelled_nodes(image, grid, nodes);
  const auto may_have = [&](const Index3& cell) { return nodes.has_flagged_node(labelled, cell); };
  const auto kept = select_everywhere(grid, may_have, [&](const PointTet& tet) {
    return std::any_of(tet.begin(), tet.end(),
                       [&](const LatticePoint& node) { return labelled[nodes.number_of(node)] != 0; });
  });

  Lattice lattice;
  lattice.frame = grid.frame;
  std::vector<VertexId> vertex(nodes.size(), kNoVertex);
  for_each_chosen(grid, kept, [&](const PointTet& tet) {
    RedTet red{};
    for (std::size_t n = 0; n < 4; ++n) {
      VertexId& v = vertex[nodes.number_of(tet[n])];
      v = v == kNoVertex ? lattice.vertex_at(tet[n]) : v;
      red.nodes[n] = v;
    }
    lattice.reds.push_back(red);
  });
  return lattice;
}

double default_lattice_spacing_mm(const ImageFrame& frame) {
  return 10 * std::cbrt(frame.spacing_mm.x * frame.spacing_mm.y * frame.spacing_mm.z);
}

double default_finest_spacing_mm(const ImageFrame& frame) {
  const Vec3& s = frame.spacing_mm;
  return std::max(s.min_coeff(), 0.5 * std::cbrt(s.x * s.y * s.z));
}

}  // namespace cbc3d
