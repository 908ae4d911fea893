// How a leaf of the octree is filled: its centre is joined to triangles on its six faces, which both sides of
// a face choose alike, so that no tet crosses the boundary of a leaf.
//
//   a face whose neighbour is finer    two triangles on each of its four quarters;
//   a face with an edge that is split  a fan from the centre of the face;
//   any other face                     two triangles; their diagonal joins the corners whose coordinates,
//                                      counted in edges of the face, have an even sum.
#pragma once

#include <array>
#include <vector>

#include "baselines/ld/label_octree.hpp"

namespace cbc3d::baselines::ld {

/// A triangle on the face of a leaf.
struct LeafTriangle {
  std::array<LatticePoint, 3> corners;  ///< such that the tet of these and the leaf's centre is positive
  int axis = 0;                         ///< of its normal
  bool is_high = false;                 ///< on the leaf's far side along the axis
};

/// Appends the triangles on the six faces of a leaf.
void append_leaf_triangles(const LabelOctree& octree, const Leaf& leaf, std::vector<LeafTriangle>& triangles);

/// The smallest dihedral angle of any tet that a leaf can be filled with: 45 degrees for cubes.
double least_template_dihedral_deg(const Vec3& cell_mm);

/// The pieces that voxels are cut into so that no tet has a smaller dihedral angle than the bound: more along
/// the longest edges of a piece, none for cubes. A third more than the bound is sought where it can be had,
/// for tets that begin at the bound leave no merges to make. Throws InputError when not even the bound can be
/// met.
Index3 pieces_for(const Vec3& spacing_mm, double min_dihedral_deg);

}  // namespace cbc3d::baselines::ld
