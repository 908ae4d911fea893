// The background lattice: body-centred cubic tets of the octree's leaves (Labelle and Shewchuk 2007, section
// 3; Bronson, Levine and Whitaker 2014, section 4).
#pragma once

#include <vector>

#include "baselines/cleaver/octree.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines::cleaver {

/// Vertices and positively oriented tets, with no regard to labels.
struct Lattice {
  std::vector<Vec3> points;  ///< local mm
  TetNodes tets;
};

/// The tets between the centres of the octree's leaves near labels. Throws JobError when they are too many
/// for their numbers.
Lattice background_lattice(const Octree& octree, const std::vector<Leaf>& leaves);

/// Leaves out the tets for which keep[tet] is 0, and the vertices that no other tet has. Returns the former
/// number of each vertex.
std::vector<VertexId> keep_tets(Lattice& lattice, const std::vector<char>& keep);

}  // namespace cbc3d::baselines::cleaver
