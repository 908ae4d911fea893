// The facets that part two materials, or a material from the outside.
#pragma once

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// A facet between two materials; the outside counts as background. The right-hand normal of its nodes points
/// from the lower material number to the higher; nodes[3] is kNoVertex for a triangle.
struct InterfaceFacet {
  std::array<VertexId, 4> nodes;
  MaterialId lower, higher;
};

/// All facets on interfaces and on the mesh surface, each once, ordered by their smallest node. Linear in the
/// cells, parallel. Throws JobError when a facet belongs to more than two cells.
std::vector<InterfaceFacet> interface_facets(const MaterialMesh& mesh, const VertexCells& around);

}  // namespace cbc3d
