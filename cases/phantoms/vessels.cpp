// A random tree of tapering vessels with an aneurysm, clean or with voxel noise: thin parts and small pieces.
#include <algorithm>
#include <cmath>
#include <vector>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/shapes.hpp"

namespace cbc3d::cases {
namespace {

// A tube from ball to ball, its radius changing linearly.
struct Tube {
  Vec3 from, to;
  double from_radius, to_radius;

  [[nodiscard]] double largest_radius() const { return std::max(from_radius, to_radius); }
  [[nodiscard]] bool holds(const Vec3& p) const {
    const Vec3 axis = to - from, d = p - from;
    const double length2 = axis.squared_norm();
    const double t = length2 > 0 ? std::clamp(d.dot(axis) / length2, 0.0, 1.0) : 0.0;
    const double radius = from_radius + t * (to_radius - from_radius);
    return (d - t * axis).squared_norm() <= radius * radius;
  }
};

struct Branch {
  Vec3 at, heading;
  double radius, length;
};

// Keeps a position at least `margin` away from the image's border.
Vec3 kept_inside(Vec3 p, const ImageFrame& frame, double margin) {
  for (int axis = 0; axis < 3; ++axis) {
    const double far = (frame.size[static_cast<std::size_t>(axis)] - 1) * frame.spacing_mm[axis];
    p[axis] = std::clamp(p[axis], std::min(margin, far / 2), std::max(far - margin, far / 2));
  }
  return p;
}

// A trunk that forks six times, two branches each; the fork after the trunk carries the aneurysm.
std::vector<Tube> grow_tree(const ImageFrame& frame, std::uint64_t seed) {
  constexpr int kGenerations = 6;
  const double side = shortest_side_mm(frame);
  const double thinnest = 0.75 * frame.spacing_mm.max_coeff();
  RandomSequence random(seed);
  const Vec3 middle = middle_of(frame);
  std::vector<Tube> tubes;
  std::vector<Branch> branches{{{middle.x, middle.y, 0.1 * side}, {0, 0, 1}, 0.045 * side, 0.22 * side}};
  for (int generation = 0; generation <= kGenerations; ++generation) {
    std::vector<Branch> next;
    for (const Branch& branch : branches) {
      const double end_radius = std::max(0.8 * branch.radius, thinnest);
      const Vec3 end = kept_inside(branch.at + branch.length * branch.heading, frame, 0.06 * side);
      tubes.push_back({branch.at, end, branch.radius, end_radius});
      if (generation == 0) {
        const Vec3 sac = end + 0.07 * side * random.direction();
        tubes.push_back({sac, sac, 0.08 * side, 0.08 * side});
      }
      for (int child = 0; child < 2; ++child) {
        const Vec3 heading = (branch.heading + 0.9 * random.direction()).normalized();
        next.push_back({end, heading, std::max(random.uniform(0.65, 0.85) * end_radius, thinnest),
                        random.uniform(0.7, 0.95) * branch.length});
      }
    }
    branches = std::move(next);
  }
  return tubes;
}

// The voxels of slice k that a tube holds.
void draw_tube(const Tube& tube, int k, LabelImage& image) {
  const ImageFrame& frame = image.frame;
  const double reach = tube.largest_radius();
  Index3 low{}, high{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double spacing = frame.spacing_mm[axis];
    low[a] = std::max(
        0, static_cast<int>(std::floor((std::min(tube.from[axis], tube.to[axis]) - reach) / spacing)));
    high[a] =
        std::min(frame.size[a] - 1,
                 static_cast<int>(std::ceil((std::max(tube.from[axis], tube.to[axis]) + reach) / spacing)));
  }
  if (k < low[2] || k > high[2]) {
    return;
  }
  for (int j = low[1]; j <= high[1]; ++j) {
    for (int i = low[0]; i <= high[0]; ++i) {
      if (tube.holds(frame.local_centre(i, j, k))) {
        image.voxels[frame.offset(i, j, k)] = 1;
      }
    }
  }
}

}  // namespace

LabelImage vessels_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  LabelImage image = blank_image(size, spacing_mm, 1);
  const std::vector<Tube> tubes = grow_tree(image.frame, seed);
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    for (const Tube& tube : tubes) {
      draw_tube(tube, k, image);
    }
  }
  return image;
}

LabelImage noisy_vessels_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  constexpr double kNoiseShare = 0.002;
  LabelImage image = vessels_phantom(size, spacing_mm, seed);
  const std::uint64_t noise_seed = mix_bits(seed ^ 0x6E6F697365ULL);
#pragma omp parallel for
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (uniform_at(noise_seed, v) < kNoiseShare) {
      image.voxels[v] = static_cast<MaterialId>(1 - image.voxels[v]);
    }
  }
  return image;
}

}  // namespace cbc3d::cases
