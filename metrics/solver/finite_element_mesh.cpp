#include "metrics/solver/finite_element_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesher/core/error.hpp"
#include "metrics/element_corners.hpp"

namespace cbc3d::solver {

namespace {

using metrics::Corner;

constexpr std::array<Corner, 1> kTetCorners{{{0, 1, 2, 3}}};
constexpr std::array<Corner, 8> kPyramidCorners = [] {
  std::array<Corner, 8> corners{};
  std::copy(metrics::kPyramidBaseCorners.begin(), metrics::kPyramidBaseCorners.end(), corners.begin());
  std::copy(metrics::kPyramidApexCorners.begin(), metrics::kPyramidApexCorners.end(), corners.begin() + 4);
  return corners;
}();

template <int Nodes, std::size_t Corners>
void require_positive(const Mesh& mesh, const CellBlock<Nodes>& block,
                      const std::array<Corner, Corners>& corners, const char* kind, const std::string& name) {
  const auto folded = [&](const auto& cell) {
    const auto at = [&](std::size_t node) -> const Vec3& { return mesh.points[cell[node]]; };
    return std::any_of(corners.begin(), corners.end(), [&](const Corner& c) {
      return !(six_volumes(at(c.at), at(c.next), at(c.previous), at(c.up)) > 0);
    });
  };
  std::size_t count = 0, first = 0;
  for (std::size_t c = block.size(); c-- > 0;) {
    if (folded(block.nodes[c])) {
      ++count;
      first = c;
    }
  }
  if (count > 0) {
    throw InputError(name + ": " + std::to_string(count) + " inverted, flat or folded " + kind +
                     " (the first is number " + std::to_string(first) +
                     " of its kind): a solver cannot use this mesh, repair it first");
  }
}

/// A face by its vertices, ascending; a triangle's last one is the largest number there is.
struct Face {
  std::array<getfem::size_type, 4> vertices;
  getfem::size_type cell;
  bgeot::short_type number;

  bool operator<(const Face& other) const {
    return vertices != other.vertices ? vertices < other.vertices : cell < other.cell;
  }
};

std::vector<Face> all_faces(const getfem::mesh& cells) {
  std::vector<Face> faces;
  faces.reserve(4 * cells.nb_convex());
  for (dal::bv_visitor cell(cells.convex_index()); !cell.finished(); ++cell) {
    const bgeot::short_type count = cells.structure_of_convex(cell)->nb_faces();
    for (bgeot::short_type number = 0; number < count; ++number) {
      Face face{{}, cell, number};
      face.vertices.fill(std::numeric_limits<getfem::size_type>::max());
      const auto vertices = cells.ind_points_of_face_of_convex(cell, number);
      std::copy(vertices.begin(), vertices.end(), face.vertices.begin());
      std::sort(face.vertices.begin(), face.vertices.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

template <int Nodes>
void extend(Box& box, const Mesh& mesh, const CellBlock<Nodes>& block) {
  for (const auto& cell : block.nodes) {
    for (const VertexId v : cell) {
      for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = std::min(box.lower[axis], mesh.points[v][axis]);
        box.upper[axis] = std::max(box.upper[axis], mesh.points[v][axis]);
      }
    }
  }
}

}  // namespace

Box bounding_box(const Mesh& mesh) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Box box{{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
  extend(box, mesh, mesh.tets);
  extend(box, mesh, mesh.pyramids);
  extend(box, mesh, mesh.wedges);
  extend(box, mesh, mesh.hexes);
  return box;
}

FiniteElementMesh::FiniteElementMesh(const Mesh& mesh, const std::string& name) {
  if (mesh.cell_count() == 0) {
    throw InputError(name + ": no volume cell to compute on; give a mesh of tets, pyramids, wedges or hexes");
  }
  require_positive(mesh, mesh.tets, kTetCorners, "tets", name);
  require_positive(mesh, mesh.pyramids, kPyramidCorners, "pyramids", name);
  require_positive(mesh, mesh.wedges, metrics::kWedgeCorners, "wedges", name);
  require_positive(mesh, mesh.hexes, metrics::kHexCorners, "hexes", name);
  box_ = bounding_box(mesh);
  // Vertices at one place stay apart: a mesh that is not joined there must not be joined here.
  for (const Vec3& p : mesh.points) {
    cells_.add_point(bgeot::base_node(p.x, p.y, p.z), 0, false);
  }
  // GetFEM numbers the nodes of squares and cubes row by row, not around.
  add_cells(mesh.tets, bgeot::simplex_geotrans(3, 1), {0, 1, 2, 3}, name);
  tets_.add(0, mesh.tets.size());
  add_cells(mesh.pyramids, bgeot::pyramid_QK_geotrans(1), {0, 1, 3, 2, 4}, name);
  add_cells(mesh.wedges, bgeot::prism_linear_geotrans(3), {0, 1, 2, 3, 4, 5}, name);
  add_cells(mesh.hexes, bgeot::parallelepiped_geotrans(3, 1), {0, 1, 3, 2, 4, 5, 7, 6}, name);
  find_faces();
  double volume = 0;
  for (dal::bv_visitor cell(cells_.convex_index()); !cell.finished(); ++cell) {
    volume += cells_.convex_area_estimate(cell);
  }
  mean_size_mm_ = std::cbrt(volume / static_cast<double>(labels_.size()));
}

template <int Nodes>
void FiniteElementMesh::add_cells(const CellBlock<Nodes>& block, const bgeot::pgeometric_trans& map,
                                  const std::array<int, Nodes>& order, const std::string& name) {
  std::array<getfem::size_type, Nodes> nodes{};
  for (std::size_t c = 0; c < block.size(); ++c) {
    for (std::size_t n = 0; n < Nodes; ++n) {
      nodes[n] = block.nodes[c][static_cast<std::size_t>(order[n])];
    }
    if (cells_.add_convex(map, nodes.begin()) != labels_.size()) {
      throw InputError(name + ": two cells have the same vertices; remove one of them");
    }
    labels_.push_back(block.labels[c]);
  }
}

void FiniteElementMesh::find_faces() {
  getfem::mesh_region boundary, interfaces;
  const std::vector<Face> faces = all_faces(cells_);
  for (std::size_t f = 0; f < faces.size();) {
    const bool shared = f + 1 < faces.size() && faces[f + 1].vertices == faces[f].vertices;
    if (!shared) {
      boundary.add(faces[f].cell, faces[f].number);
    } else if (labels_[faces[f].cell] != labels_[faces[f + 1].cell]) {
      interfaces.add(faces[f].cell, faces[f].number);
      interfaces.add(faces[f + 1].cell, faces[f + 1].number);
    }
    f += shared ? 2 : 1;
  }
  cells_.region(kBoundary) = boundary;
  cells_.region(kInterfaces) = interfaces;
}

}  // namespace cbc3d::solver
