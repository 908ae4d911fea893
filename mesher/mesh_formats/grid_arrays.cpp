#include "mesher/mesh_formats/grid_arrays.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

// VTK's numbers of cell types.
constexpr int kEmpty = 0, kQuadratic = 21;
constexpr int kTet = 10, kHex = 12, kWedge = 13, kPyramid = 14;

constexpr const char* kDamaged = "; the file is damaged, write it again";

/// Nodes of a volume cell; 0 for other types.
std::size_t nodes_of(int type) {
  switch (type) {
    case kTet:
      return 4;
    case kPyramid:
      return 5;
    case kWedge:
      return 6;
    case kHex:
      return 8;
    default:
      return 0;
  }
}

/// Points, lines, triangles and so on: boundary markers of other tools.
bool is_of_lower_dimension(int type) {
  return type >= kEmpty && type <= 9;
}

class Checker {
 public:
  Checker(const GridArrays& grid, const std::string& subject) : grid_(grid), subject_(subject) {}

  void require_lengths() const {
    const std::size_t cells = grid_.types.size();
    if (grid_.offsets.size() != cells + 1 || grid_.labels.size() != cells) {
      fail("it has " + std::to_string(cells) + " cell types, " +
           std::to_string(grid_.offsets.empty() ? 0 : grid_.offsets.size() - 1) + " cells and " +
           std::to_string(grid_.labels.size()) + " labels" + kDamaged);
    }
    std::int64_t before = 0;
    for (const std::int64_t offset : grid_.offsets) {
      if (offset < before || offset > static_cast<std::int64_t>(grid_.connectivity.size())) {
        fail("the offset " + std::to_string(offset) + " of its cells is not between the one before it and " +
             std::to_string(grid_.connectivity.size()) + kDamaged);
      }
      before = offset;
    }
    if (grid_.points.size() >= std::numeric_limits<VertexId>::max()) {
      fail("it has " + std::to_string(grid_.points.size()) + " points, more than can be numbered");
    }
  }

  void require_points() const {
    for (std::size_t v = 0; v < grid_.points.size(); ++v) {
      if (!grid_.points[v].all_finite()) {
        fail("point " + std::to_string(v) + " has a coordinate that is no finite number" + kDamaged);
      }
    }
  }

  [[nodiscard]] Label label_of(std::size_t cell) const {
    const double label = grid_.labels[cell];
    if (!(label == std::floor(label)) || label > std::numeric_limits<Label>::max() ||
        label < std::numeric_limits<Label>::min()) {
      char text[64];
      std::snprintf(text, sizeof text, "%.17g", label);
      fail("cell " + std::to_string(cell) + " has the label " + text + "; give integer labels of 32 bits");
    }
    return static_cast<Label>(label);
  }

  /// The nodes of a volume cell, checked.
  [[nodiscard]] const std::int64_t* nodes(std::size_t cell, std::size_t count) const {
    const std::int64_t begin = grid_.offsets[cell], found = grid_.offsets[cell + 1] - begin;
    if (found != static_cast<std::int64_t>(count)) {
      fail("cell " + std::to_string(cell) + " of VTK type " + std::to_string(grid_.types[cell]) + " has " +
           std::to_string(found) + " nodes, not " + std::to_string(count) + kDamaged);
    }
    const std::int64_t* const ids = grid_.connectivity.data() + begin;
    for (std::size_t n = 0; n < count; ++n) {
      if (ids[n] < 0 || ids[n] >= static_cast<std::int64_t>(grid_.points.size())) {
        fail("cell " + std::to_string(cell) + " has node " + std::to_string(ids[n]) + ", but there are " +
             std::to_string(grid_.points.size()) + " points" + kDamaged);
      }
    }
    return ids;
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(subject_ + ": " + what); }

 private:
  const GridArrays& grid_;
  const std::string& subject_;
};

template <int Nodes>
void take_cell(CellBlock<Nodes>& block, const std::int64_t* ids, bool wedge, Label label) {
  std::array<VertexId, Nodes> cell;
  for (int n = 0; n < Nodes; ++n) {
    cell[static_cast<std::size_t>(n)] =
        static_cast<VertexId>(ids[wedge ? kWedgeOrder[n % 6] : static_cast<std::size_t>(n)]);
  }
  block.add(cell, label);
}

void take_volume(Mesh& mesh, int type, const std::int64_t* ids, Label label) {
  switch (type) {
    case kTet:
      return take_cell(mesh.tets, ids, false, label);
    case kPyramid:
      return take_cell(mesh.pyramids, ids, false, label);
    case kWedge:
      return take_cell(mesh.wedges, ids, true, label);
    default:
      return take_cell(mesh.hexes, ids, false, label);
  }
}

}  // namespace

Mesh mesh_of_grid(const GridArrays& grid, const std::string& subject) {
  const Checker checker(grid, subject);
  checker.require_lengths();
  checker.require_points();
  Mesh mesh;
  mesh.points = grid.points;
  for (std::size_t c = 0; c < grid.types.size(); ++c) {
    const int type = grid.types[c];
    if (const std::size_t count = nodes_of(type); count > 0) {
      take_volume(mesh, type, checker.nodes(c, count), checker.label_of(c));
    } else if (!is_of_lower_dimension(type)) {
      checker.fail("it has cells of VTK type " + std::to_string(type) +
                   (type >= kQuadratic ? " (of higher order)" : "") +
                   "; known are linear tets, pyramids, wedges and hexes");
    }
  }
  if (mesh.cell_count() == 0) {
    checker.fail("it has no tets, pyramids, wedges or hexes; give a volume mesh");
  }
  return mesh;
}

}  // namespace cbc3d
