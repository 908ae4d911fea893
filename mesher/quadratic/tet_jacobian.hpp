// The Jacobian of a quadratic tet, bounded everywhere by numbers (Johnen, Remacle and Geuzaine, "Geometrical
// validity of curvilinear finite elements", J. Comput. Phys. 233, 2013).
//
// The Jacobian determinant of a quadratic tet is a cubic polynomial. Written in the Bernstein basis it has
// twenty coefficients, between the least and the largest of which it stays; their mean is its mean over the
// tet.
#pragma once

#include <array>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

/// Its coefficients; nodes as in QuadraticMesh. Of a straight tet all are six times its volume.
std::array<double, 20> jacobian_coefficients(const std::array<Vec3, 10>& nodes);

/// The least of them over six times the volume of the tet of the corners; negative where that is not
/// positive.
double least_relative_jacobian(const std::array<Vec3, 10>& nodes);

/// The volume of the curved tet.
double volume_of_quadratic_tet(const std::array<Vec3, 10>& nodes);

}  // namespace cbc3d
