// The quality measures of the deformation's quality control (paper, section "Quality control"): the minimum
// dihedral angle of tets, the scaled Jacobian of hexes and pyramids (Knupp).
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

/// Cosine of the smallest dihedral angle of a tet; 2 for a flat or inverted one.
double max_dihedral_cosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// True only if the tet is positively oriented and no dihedral angle's cosine is above `cosine` (>= 0). A
/// quick test in floats that most tets pass: near the bound, and of slim tets, it says false.
bool surely_no_cosine_above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double cosine);

/// The smallest dihedral angle of a tet, degrees; 0 for a flat or inverted tet.
double min_dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Scaled Jacobian of a pyramid: the smallest over the base corners of det / (product of edge lengths), times
/// sqrt(3), so that the transition pyramid of the BCC lattice (height half the base) has 1; cut off at 1.
double scaled_jacobian_pyramid(std::span<const Vec3, 5> p);

/// Scaled Jacobian of a hex: the smallest over its corners and its centre; 1 for a box.
double scaled_jacobian_hex(std::span<const Vec3, 8> p);

}  // namespace cbc3d
