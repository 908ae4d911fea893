#include "cases/phantoms/brain.hpp"

#include <algorithm>
#include <cmath>

#include "cases/phantoms/noise.hpp"
#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

// All lengths in the brain's own frame.
const Vec3 kRoom{160, 196, 152};  // what the brain needs along each axis
const Vec3 kCerebrumCentre{0, 0, 12}, kCerebrumRadii{68, 84, 58};
const Vec3 kCerebellumCentre{0, 44, -36}, kCerebellumRadii{46, 30, 25};

/// About the distance below an ellipsoid's surface (exact on it); `u` is the direction, scaled to a ball.
double depth_below(const Vec3& p, const Vec3& radii, Vec3& u) {
  const Vec3 q{p.x / radii.x, p.y / radii.y, p.z / radii.z};
  const double length = q.norm();
  u = length > 0 ? q / length : Vec3{0, 0, 1};
  const double slope = Vec3{q.x / radii.x, q.y / radii.y, q.z / radii.z}.norm();
  return slope > 0 ? length * (1 - length) / slope : radii.min_coeff();
}

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

BrainShape::BrainShape(const Vec3& extent_mm, std::uint64_t seed)
    : middle_mm_(0.5 * extent_mm),
      scale_(Vec3{extent_mm.x / kRoom.x, extent_mm.y / kRoom.y, extent_mm.z / kRoom.z}.min_coeff()),
      seed_(mix_bits(seed)),
      stem_({{0, 16, -18}, 17}, {{0, 26, -64}, 8}) {}

bool BrainShape::holds(const Vec3& local_mm) const {
  const Vec3 p = (local_mm - middle_mm_) / scale_;
  return in_cerebrum(p) || in_cerebellum(p) || stem_.distance_mm(p) <= 0;
}

// The furrows are sheets that stand upright on the surface, where a noise of the direction alone is zero;
// they narrow with depth. Towards them the surface is rounded.
bool BrainShape::in_cerebrum(const Vec3& p) const {
  constexpr double kDeepest = 20, kFoldsPerRadius = 5.5, kNoisePerLength = 0.085;
  Vec3 u;
  double depth = depth_below(p - kCerebrumCentre, kCerebrumRadii, u);
  if (depth < 0) {
    return false;
  }
  const double fissure_half_width = 1.6 - 0.06 * depth;
  if (std::abs(p.x) < fissure_half_width && p.z > 24) {
    return false;
  }
  if (depth > kDeepest) {
    return true;
  }
  const Vec3 warp{gradient_noise(seed_ + 1, 3 * u), gradient_noise(seed_ + 2, 3 * u),
                  gradient_noise(seed_ + 3, 3 * u)};
  const Vec3 at = kFoldsPerRadius * u + 0.75 * warp;
  const double furrow = std::abs(gradient_noise(seed_ + 4, at) + 0.35 * gradient_noise(seed_ + 5, 2.1 * at));
  depth -= 2 + 1.5 * gradient_noise(seed_ + 6, 2.5 * u) + 4 * (1 - smooth_step(0, 0.3, furrow));
  const double furrow_depth = 11 + 5 * gradient_noise(seed_ + 7, 2 * at);
  const double half_width = 1.1 * (1 - std::max(depth, 0.0) / furrow_depth);
  return depth >= 0 && furrow >= kNoisePerLength * half_width;
}

// Thin leaves, one above the other, parted by level furrows.
bool BrainShape::in_cerebellum(const Vec3& p) const {
  constexpr double kLeaf = 5.5;
  Vec3 u;
  const double depth = depth_below(p - kCerebellumCentre, kCerebellumRadii, u);
  if (depth < 0 || depth > 6) {
    return depth >= 0;
  }
  const double level = (p.z + 0.25 * p.y + 2 * gradient_noise(seed_ + 8, 2 * u)) / kLeaf;
  const double off = kLeaf * std::abs(level - std::floor(level) - 0.5);  // from the furrow's middle
  return off >= 0.9 * (1 - depth / 6);
}

Tubes BrainShape::ventricles(double thinnest_mm) const {
  Tubes tubes;
  const auto path = [&](double side, std::initializer_list<std::pair<Vec3, double>> anatomical) {
    std::vector<Knot> knots;
    for (const auto& [at, radius] : anatomical) {
      knots.push_back({place({side * at.x, at.y, at.z}), std::max(scale_ * radius, thinnest_mm)});
    }
    tubes.add_path(smooth_path(knots, 8));
  };
  for (const double side : {1.0, -1.0}) {
    path(side, {{{13, -38, 12}, 3.5},
                {{10, -26, 21}, 6},
                {{11, -4, 26}, 5.5},
                {{15, 14, 24}, 6},
                {{21, 26, 16}, 7.5},
                {{23, 42, 11}, 4},
                {{22, 54, 9}, 2}});
    path(side, {{{21, 26, 16}, 7}, {{29, 20, 2}, 5}, {{33, 6, -8}, 3.5}, {{33, -10, -13}, 2.5}});
    path(side, {{{10, -14, 23}, 2}, {{4, -11, 15}, 1.8}, {{0, -8, 9}, 2}});
  }
  path(1, {{{0, -10, 4}, 2.2}, {{0, 0, 10}, 3}, {{0, 12, 8}, 2.2}, {{0, 24, -14}, 1.6}, {{0, 30, -26}, 3}});
  return tubes;
}

}  // namespace cbc3d::cases
