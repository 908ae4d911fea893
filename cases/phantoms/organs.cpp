// A body with organs that touch: every kind of junction between three and four materials in a small image.
#include <cmath>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/shapes.hpp"

namespace cbc3d::cases {
namespace {

bool in_ball(const Vec3& p, const Vec3& centre, double radius) {
  return (p - centre).squared_norm() <= radius * radius;
}

bool in_body(const Vec3& p, const OrgansShape& shape) {
  const Vec3 d = p - shape.body_centre, &r = shape.body_radii;
  return Vec3{d.x / r.x, d.y / r.y, d.z / r.z}.squared_norm() <= 1;
}

bool in_ring(const Vec3& p, const OrgansShape& shape) {
  const Vec3 d = p - shape.ring_centre;
  const double along = d.dot(shape.ring_axis);
  const double out = (d - along * shape.ring_axis).norm() - shape.ring_radius;
  return along * along + out * out <= shape.tube_radius * shape.tube_radius;
}

}  // namespace

OrgansShape organs_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  ImageFrame frame;
  frame.size = size;
  frame.spacing_mm = spacing_mm;
  const double side = shortest_side_mm(frame);
  const Vec3 middle = middle_of(frame);
  RandomSequence random(seed);
  const Vec3 body_shift = random.in_box(0.01 * side), organ_shift = random.in_box(0.02 * side);
  OrgansShape shape{};
  shape.body_centre = middle + body_shift;
  shape.body_radii = side * Vec3{0.45, 0.39, 0.42};
  shape.organ_centre = middle + side * Vec3{-0.08, 0.02, -0.02} + organ_shift;
  shape.organ_radius = 0.17 * side;
  shape.ring_centre = shape.organ_centre;
  shape.ring_axis = Vec3{0.3, 0.2, 1}.normalized();
  shape.ring_radius = 0.2 * side;
  shape.tube_radius = 0.05 * side;
  shape.lesion_centre = shape.organ_centre + 0.09 * side * shape.ring_axis;
  shape.lesion_radius = 0.05 * side;
  return shape;
}

LabelImage organs_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const OrgansShape shape = organs_shape(size, spacing_mm, seed);
  LabelImage image = blank_image(size, spacing_mm, 4);
  fill_image(image, [&shape](const Vec3& p) -> MaterialId {
    if (in_ball(p, shape.lesion_centre, shape.lesion_radius)) {
      return 4;
    }
    if (in_ring(p, shape)) {
      return 3;
    }
    if (in_ball(p, shape.organ_centre, shape.organ_radius)) {
      return 2;
    }
    return in_body(p, shape) ? 1 : kBackground;
  });
  return image;
}

}  // namespace cbc3d::cases
