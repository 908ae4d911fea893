// How thick the parts of a mesh are at its interfaces: there edges should be no longer than a part is thick
// by far, or its tets are flat however their angles are repaired.
#pragma once

#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// At every vertex on an interface, the length of the way through each material there against the mean normal
/// of its facets, by the domain's materials: the smallest, mm. Infinite at other vertices, and where the way
/// is `largest_mm` or longer. Background has no thickness, and no part is thinner than a cell of the domain,
/// for tips of wedges are not thin parts. Right to about a quarter of a cell, and too large where the normal
/// leans. Parallel.
std::vector<double> thickness_at_vertices(const MaterialMesh& mesh, const Domain& domain, double largest_mm);

}  // namespace cbc3d
