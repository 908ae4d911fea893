// Linked rings: smooth tubes that bend, down to two voxels of radius, with no junction and no end.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/shapes.hpp"

namespace cbc3d::cases {
namespace {

// Signed distance to a ring, mm, negative inside.
double distance_mm(const Ring& ring, const Vec3& p) {
  const Vec3 d = p - ring.centre;
  const double along = d.dot(ring.axis);
  const double out = (d - along * ring.axis).norm() - ring.radius;
  return std::sqrt(along * along + out * out) - ring.tube_radius;
}

}  // namespace

std::array<Ring, 3> rings_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  ImageFrame frame;
  frame.size = size;
  frame.spacing_mm = spacing_mm;
  const double side = shortest_side_mm(frame);
  RandomSequence random(seed);
  const Vec3 middle = middle_of(frame) + random.in_box(0.01 * side);
  const Vec3 axis = random.direction();
  const Vec3 across = axis.cross(random.direction()).normalized();  // in the plane of the first ring
  const Vec3 other_axis = axis.cross(across);
  const double radius = 0.25 * side;
  return {{{middle, axis, radius, 0.075 * side},
           {middle + radius * across, other_axis, 0.1625 * side, 0.04375 * side},
           {middle - radius * across, other_axis, 0.14 * side, 0.025 * side}}};
}

LabelImage rings_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const std::array<Ring, 3> rings = rings_shape(size, spacing_mm, seed);
  LabelImage image = blank_image(size, spacing_mm, static_cast<int>(rings.size()));
  fill_image(image, [&rings](const Vec3& p) {
    const auto* const ring =
        std::find_if(rings.begin(), rings.end(), [&p](const Ring& r) { return distance_mm(r, p) <= 0; });
    return ring == rings.end() ? kBackground : static_cast<MaterialId>(1 + (ring - rings.begin()));
  });
  return image;
}

SignedDistance rings_distance(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  return [rings = rings_shape(size, spacing_mm, seed)](const Vec3& physical_mm, Label label) {
    const auto ring = static_cast<std::size_t>(label) - 1;  // label 0 becomes a large number
    return ring < rings.size() ? distance_mm(rings[ring], physical_mm)
                               : std::numeric_limits<double>::quiet_NaN();
  };
}

}  // namespace cbc3d::cases
