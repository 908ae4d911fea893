// Volumes of cells by their facets alone.
#pragma once

#include "mesher/topology/interface_facets.hpp"

namespace cbc3d::testing {

/// Volume of a pyramid or hex with planar faces or not: the divergence theorem over its facets, fanned from
/// their means.
inline double volume_of_cell(const MaterialMesh& mesh, CellId cell) {
  const auto n = mesh.nodes_of(cell);
  if (n.size() == 4) {
    return six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
  }
  MaterialMesh one;
  one.points = mesh.points;
  if (n.size() == 5) {
    one.pyramids.add({n[0], n[1], n[2], n[3], n[4]}, 1);
  } else {
    one.hexes.add({n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]}, 1);
  }
  double six = 0;
  for (const InterfaceFacet& f : interface_facets(one, cells_of_vertices(one))) {
    const std::size_t corners = f.nodes[3] == kNoVertex ? 3 : 4;
    Vec3 mean;
    for (std::size_t c = 0; c < corners; ++c) {
      mean += mesh.points[f.nodes[c]] / static_cast<double>(corners);
    }
    for (std::size_t c = 0; c < corners; ++c) {
      six += mean.dot(mesh.points[f.nodes[c]].cross(mesh.points[f.nodes[(c + 1) % corners]]));
    }
  }
  return -six / 6;  // the normals point from background, the lower number, into the cell
}

inline double volume_of_material(const MaterialMesh& mesh, MaterialId material) {
  double sum = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    sum += mesh.material_of(c) == material ? volume_of_cell(mesh, c) : 0;
  }
  return sum;
}

}  // namespace cbc3d::testing
