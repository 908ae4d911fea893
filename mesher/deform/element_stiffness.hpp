// Stiffness of linear isotropic elasticity on tets, pyramids and hexes (paper, section "Mesh Deformation": K
// is made of element matrices computed at the integration points of Gaussian quadrature; Bathe, Finite
// Element Procedures).
//
// Notation: N_n  shape function of node n: linear on tets, trilinear on hexes; a pyramid's are those of a hex
// whose upper
//           four nodes fall together at the apex, so that its triangles are linear as the tets' and its base
//           bilinear as the hexes'; g_n gradient of N_n, 1/mm; lambda, mu  Lame's constants.
#pragma once

#include <array>
#include <span>

#include "mesher/core/float4.hpp"
#include "mesher/core/vec3.hpp"

namespace cbc3d {

struct ElasticMaterial {
  double young_pa = 2100;  ///< Young's modulus, Pa (as the paper's ancestor had it)
  double poisson = 0.45;   ///< Poisson's ratio, in [0, 0.5)
};

/// N/mm^2, to go with mm.
struct LameConstants {
  double lambda, mu;
};
LameConstants lame_constants(const ElasticMaterial& material);

/// Row-major 3x3.
using StiffnessBlock = std::array<double, 9>;

/// Adds one row of an element's stiffness matrix, N/mm: to *row[n] the block that couples node `own` with
/// node n, where row[n] is not null. `points`: the nodes of a tet (4), pyramid (5) or hex (8) in Mesh's
/// order; `row` has as many entries. 2x2x2 points integrate the gradients exactly, so that linear
/// displacements pass the patch test. Integration points with no positive Jacobian (an inverted element) add
/// nothing.
void add_element_stiffness_row(std::span<const Vec3> points, std::size_t own, const LameConstants& lame,
                               std::span<StiffnessBlock* const> row);

/// Gradients of the shape functions of a tet's nodes 1, 2, 3, times the root of (mu times volume): products
/// of two of them are terms of the stiffness matrix, N/mm. Node 0's is minus their sum.
using TetGradients = std::array<Float4, 3>;

/// Zeros for a tet that is inverted or flat.
TetGradients tet_gradients(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double mu);

}  // namespace cbc3d
