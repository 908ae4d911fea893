// Balls within balls: smooth interfaces with no junction, every volume known.
#include <algorithm>
#include <limits>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/shapes.hpp"

namespace cbc3d::cases {

ShellsShape shells_shape(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  ImageFrame frame;
  frame.size = size;
  frame.spacing_mm = spacing_mm;
  const double side = shortest_side_mm(frame);
  RandomSequence random(seed);
  return {middle_of(frame) + random.in_box(0.01 * side),
          {0.45 * side, 0.35 * side, 0.26 * side, 0.13 * side}};
}

LabelImage shells_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const ShellsShape shape = shells_shape(size, spacing_mm, seed);
  LabelImage image = blank_image(size, spacing_mm, static_cast<int>(shape.radii.size()));
  fill_image(image, [&shape](const Vec3& p) {
    const double squared = (p - shape.centre).squared_norm();
    MaterialId material = kBackground;
    for (const double radius : shape.radii) {
      material = static_cast<MaterialId>(material + (squared <= radius * radius ? 1 : 0));
    }
    return material;
  });
  return image;
}

SignedDistance shells_distance(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  // Phantoms have their origin at 0 and axes along the patient's: local positions are physical ones.
  return [shape = shells_shape(size, spacing_mm, seed)](const Vec3& physical_mm, Label label) {
    const double radius = (physical_mm - shape.centre).norm();
    const auto shell = static_cast<std::size_t>(label);
    if (shell < 1 || shell > shape.radii.size()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double outside = radius - shape.radii[shell - 1];
    return shell < shape.radii.size() ? std::max(outside, shape.radii[shell] - radius) : outside;
  };
}

}  // namespace cbc3d::cases
