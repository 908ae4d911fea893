// Shape measures of one element.
#pragma once

#include <array>

#include "mesher/core/mesh.hpp"

namespace cbc3d::metrics {

/// The six dihedral angles of a tetrahedron, degrees in [0,180]; of an inverted one those of its mirror
/// image. Edges in the order 01 02 03 12 13 23.
std::array<double, 6> dihedral_angles_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Verdict's scaled Jacobian of a tetrahedron: 1 regular, .9428 BCC, .7071 right corner, negative inverted;
/// 0 for a degenerate one.
double scaled_jacobian_tet(const std::array<Vec3, 4>& p);
/// Verdict's (1.4) scaled Jacobian of a pyramid: smallest of the four tets on the base corners, 1 when all
/// eight edges are equal; 0 when inverted.
double scaled_jacobian_pyramid(const std::array<Vec3, 5>& p);
/// Smallest base corner Jacobian times sqrt(3): 1 for the pyramid over a face of a body-centred cubic lattice
/// (height half the base). Negative when inverted.
double scaled_jacobian_pyramid_bcc(const std::array<Vec3, 5>& p);
/// Verdict's scaled Jacobian of a wedge: 1 for a right prism over an equilateral triangle.
double scaled_jacobian_wedge(const std::array<Vec3, 6>& p);
/// Verdict's scaled Jacobian of a hexahedron, over corners and centre: 1 for a box.
double scaled_jacobian_hex(const std::array<Vec3, 8>& p);

/// Circumradius over three times the inradius, as Verdict has it: 1 regular, 1.0541 BCC, infinite for a flat
/// tet; of an inverted one that of its mirror image. (Others give the inverse, in [0,1].)
double radius_ratio_tet(const std::array<Vec3, 4>& p);
/// Mean ratio 12 (3V)^(2/3) / (sum of the squared edge lengths) (Liu and Joe 1994): 1 regular, 0 flat,
/// negative inverted.
double mean_ratio_tet(const std::array<Vec3, 4>& p);

}  // namespace cbc3d::metrics
