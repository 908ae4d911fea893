// The generators behind the registry. Lengths scale with the image's shortest side, so that any size works.
#pragma once

#include <array>
#include <cstdint>

#include "cases/phantoms/model.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

LabelImage organs_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
LabelImage shells_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
LabelImage rings_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
LabelImage vessels_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
LabelImage noisy_vessels_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
/// Well-composed. `size` is the largest and `spacing_mm` the finest that a seed draws; the image has an
/// origin and directions of its own.
LabelImage assorted_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

/// The analytic shapes of organs_phantom; a voxel takes the label of the last that holds its centre.
struct OrgansShape {
  Vec3 body_centre, body_radii;  ///< ellipsoid
  Vec3 organ_centre;
  double organ_radius;  ///< ball
  Vec3 ring_centre, ring_axis;
  double ring_radius, tube_radius;  ///< torus, wholly inside the body, partly inside the organ
  Vec3 lesion_centre;
  double lesion_radius;  ///< ball, wholly inside the organ, clear of the ring
};
OrgansShape organs_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

/// The common centre and the radii of shells_phantom, outermost first.
struct ShellsShape {
  Vec3 centre;
  std::array<double, 4> radii;
};
ShellsShape shells_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

/// Exact everywhere. A label's region but the innermost lies between two spheres.
SignedDistance shells_distance(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

/// A ring: the points nearer to a circle than `tube_radius`.
struct Ring {
  Vec3 centre, axis;  ///< of the circle; axis of length 1
  double radius, tube_radius;
};

/// The rings of rings_phantom, label 1 first: 2 and 3 are links through opposite sides of 1, nowhere nearer
/// to each other than to it.
std::array<Ring, 3> rings_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

/// Exact everywhere.
SignedDistance rings_distance(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

}  // namespace cbc3d::cases
