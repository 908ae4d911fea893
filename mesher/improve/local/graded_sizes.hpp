// How long elements may be at every vertex, so that they grow away from the interfaces no faster than asked.
#pragma once

#include <vector>

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// At every vertex the smallest, over the vertices on interfaces, of the mean length of its interface edges
/// plus `gradation` times the length of the way from there along the mesh's edges, mm, and no more than
/// `largest_mm`. `gradation` is not negative.
std::vector<double> graded_sizes(const MaterialMesh& mesh, double gradation, double largest_mm);

}  // namespace cbc3d
