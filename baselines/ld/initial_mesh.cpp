#include "baselines/ld/initial_mesh.hpp"

#include <algorithm>

#include "baselines/ld/leaf_templates.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// Numbers the cells of a cube with `side` of them along each edge, in the order of voxels.
ImageFrame cube_frame(int side) {
  return {.size = {side, side, side}};
}

std::size_t offset_in_cube(int side, const Index3& cell) {
  return cube_frame(side).offset(cell[0], cell[1], cell[2]);
}

/// The materials of a block's cells and of one layer around it.
class BlockCells {
 public:
  BlockCells(const CellGrid& grid, const Index3& low)
      : low_(low), side_(grid.block() + 2), cells_(cube_frame(side_).voxel_count()) {
    MaterialId* row = cells_.data();
    for (int k = 0; k < side_; ++k) {
      for (int j = 0; j < side_; ++j, row += side_) {
        grid.read_row(low[0] - 1, low[0] - 1 + side_, low[1] - 1 + j, low[2] - 1 + k, row);
      }
    }
  }

  [[nodiscard]] MaterialId at(const Index3& cell) const {
    return cells_[offset_in_cube(side_,
                                 {cell[0] - low_[0] + 1, cell[1] - low_[1] + 1, cell[2] - low_[2] + 1})];
  }

  [[nodiscard]] CellsAround around(const Index3& corner) const {
    CellsAround around{};
    for (int c = 0; c < 8; ++c) {
      around[static_cast<std::size_t>(c)] =
          at({corner[0] - 1 + (c & 1), corner[1] - 1 + (c >> 1 & 1), corner[2] - 1 + (c >> 2)});
    }
    return around;
  }

 private:
  Index3 low_;
  int side_;
  std::vector<MaterialId> cells_;
};

class BlockFiller {
 public:
  BlockFiller(const CellGrid& grid, const LabelOctree& octree, const Index3& block,
              const InitialMeshOptions& options)
      : grid_(grid),
        octree_(octree),
        options_(options),
        low_{block[0] * grid.block(), block[1] * grid.block(), block[2] * grid.block()},
        cells_(grid, low_),
        corners_(grid.block() + 1),
        ids_(cube_frame(corners_).voxel_count(), kNoVertex) {}

  void fill(const Leaf& leaf) {
    const MaterialId material = cells_.at(leaf.low);
    if (material == kBackground && !options_.with_background) return;
    triangles_.clear();
    append_leaf_triangles(octree_, leaf, triangles_);
    const VertexId centre = add_centre(leaf);
    for (const LeafTriangle& t : triangles_) {
      const std::array<VertexId, 3> v{corner(t.corners[0]), corner(t.corners[1]), corner(t.corners[2])};
      mesh_.tets.push_back({v[0], v[1], v[2], centre});
      mesh_.materials.push_back(material);
      // Of the two leaves at a facet between materials the one with the larger lists its piece.
      if (options_.with_pieces && cell_across(t) < material) add_piece(t, v);
    }
  }

  LatticeMesh take() { return std::move(mesh_); }

 private:
  VertexId add_centre(const Leaf& leaf) {
    mesh_.points.push_back(centre_of(leaf));
    mesh_.states.emplace_back();
    return static_cast<VertexId>(mesh_.points.size() - 1);
  }

  VertexId corner(const LatticePoint& point) {
    Index3 cell{};
    for (std::size_t a = 0; a < 3; ++a) cell[a] = point[a] / 2;
    VertexId& id = ids_[offset_in_cube(corners_, {cell[0] - low_[0], cell[1] - low_[1], cell[2] - low_[2]})];
    if (id == kNoVertex) {
      id = static_cast<VertexId>(mesh_.points.size());
      mesh_.points.push_back(point);
      mesh_.states.push_back(state_of(cell));
    }
    return id;
  }

  [[nodiscard]] VertexState state_of(const Index3& cell) const {
    const CellsAround around = cells_.around(cell);
    VertexState state{.stratum = stratum_of(around), .normal_axes = normal_axes_of(around)};
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] == low_[a] || cell[a] == low_[a] + grid_.block()) state.is_frozen = true;
      if (options_.with_background && (cell[a] == 0 || cell[a] == grid_.size()[a]))
        state.stratum = Stratum::point;
    }
    return state;
  }

  [[nodiscard]] MaterialId cell_across(const LeafTriangle& t) const {
    Index3 cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      cell[a] = (t.corners[0][a] + t.corners[1][a] + t.corners[2][a]) / 6;  // of the centroid
    }
    const auto axis = static_cast<std::size_t>(t.axis);
    cell[axis] = t.corners[0][axis] / 2 - (t.is_high ? 0 : 1);
    return cells_.at(cell);
  }

  void add_piece(const LeafTriangle& t, const std::array<VertexId, 3>& v) {
    BoundaryPiece piece{t.corners, v};
    for (auto& c : piece.corners) {
      for (auto& x : c) x *= BoundaryPiece::kUnitsPerHalfCell;
    }
    mesh_.pieces.push_back(piece);
  }

  const CellGrid& grid_;
  const LabelOctree& octree_;
  InitialMeshOptions options_;
  Index3 low_;
  BlockCells cells_;
  int corners_;                // of cells along an edge of the block
  std::vector<VertexId> ids_;  // of the corners of cells
  std::vector<LeafTriangle> triangles_;
  LatticeMesh mesh_;
};

}  // namespace

LatticeMesh initial_mesh(const CellGrid& grid, const LabelOctree& octree, const Index3& block,
                         const InitialMeshOptions& options) {
  const int side = grid.block();
  const bool is_uniform = !octree.is_split(octree.levels(), block);
  if (is_uniform && !options.with_background &&
      grid.at(block[0] * side, block[1] * side, block[2] * side) == kBackground) {
    return {};
  }
  std::vector<Leaf> leaves;
  octree.append_leaves(block, leaves);
  BlockFiller filler(grid, octree, block, options);
  for (const Leaf& leaf : leaves) filler.fill(leaf);
  return filler.take();
}

}  // namespace cbc3d::baselines::ld
