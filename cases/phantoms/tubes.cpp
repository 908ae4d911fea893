#include "cases/phantoms/tubes.hpp"

#include <algorithm>
#include <limits>

namespace cbc3d::cases {
namespace {

double sign(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

struct Range {
  int low, high;  // both inclusive
};

Range voxels_between(double low_mm, double high_mm, double spacing_mm, int size) {
  return {std::max(0, static_cast<int>(std::floor(low_mm / spacing_mm))),
          std::min(size - 1, static_cast<int>(std::ceil(high_mm / spacing_mm)))};
}

/// Distance from a box; 0 inside.
double box_distance(const RoundCone& cone, const Vec3& p) {
  Vec3 outside;
  for (int axis = 0; axis < 3; ++axis) {
    outside[axis] = std::max({cone.low()[axis] - p[axis], p[axis] - cone.high()[axis], 0.0});
  }
  return outside.norm();
}

Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double t) {
  return 0.5 * ((2 * b) + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * (t * t) +
                (3 * b - a - 3 * c + d) * (t * t * t));
}

}  // namespace

RoundCone::RoundCone(const Knot& from, const Knot& to)
    : from_(from.at), axis_(to.at - from.at), from_radius_(from.radius_mm), to_radius_(to.radius_mm) {
  const double drop = from_radius_ - to_radius_;
  if (axis_.squared_norm() <= drop * drop) {  // one ball holds the other
    from_ = drop >= 0 ? from.at : to.at;
    from_radius_ = to_radius_ = std::max(from.radius_mm, to.radius_mm);
    axis_ = {};
  }
  radius_drop_ = from_radius_ - to_radius_;
  length2_ = axis_.squared_norm();
  slope2_ = length2_ - radius_drop_ * radius_drop_;
  inverse_length2_ = length2_ > 0 ? 1 / length2_ : 0;
  const Vec3 end = from_ + axis_;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = std::min(from_[axis] - from_radius_, end[axis] - to_radius_);
    high_[axis] = std::max(from_[axis] + from_radius_, end[axis] + to_radius_);
  }
}

// I. Quilez, "round cone" among the distance functions on iquilezles.org; square roots alone.
double RoundCone::distance_mm(const Vec3& p) const {
  const Vec3 d = p - from_;
  if (length2_ == 0) {
    return d.norm() - from_radius_;
  }
  const double y = d.dot(axis_), z = y - length2_;
  const double x2 = (d * length2_ - axis_ * y).squared_norm();
  const double y2 = y * y * length2_, z2 = z * z * length2_;
  const double k = sign(radius_drop_) * radius_drop_ * radius_drop_ * x2;
  if (sign(z) * slope2_ * z2 > k) {
    return std::sqrt(x2 + z2) * inverse_length2_ - to_radius_;
  }
  if (sign(y) * slope2_ * y2 < k) {
    return std::sqrt(x2 + y2) * inverse_length2_ - from_radius_;
  }
  return (std::sqrt(x2 * slope2_ * inverse_length2_) + y * radius_drop_) * inverse_length2_ - from_radius_;
}

void Tubes::add_path(const std::vector<Knot>& knots) {
  for (std::size_t knot = 1; knot < knots.size(); ++knot) {
    cones_.emplace_back(knots[knot - 1], knots[knot]);
  }
}

double Tubes::distance_mm(const Vec3& local_mm) const {
  double least = std::numeric_limits<double>::infinity();
  for (const RoundCone& cone : cones_) {
    const double bound = box_distance(cone, local_mm);
    if (bound < least || bound == 0) {
      least = std::min(least, cone.distance_mm(local_mm));
    }
  }
  return least;
}

void Tubes::paint(const ImageFrame& frame, int k, PaintedVoxel material, PaintedVoxel* slice) const {
  const Vec3& spacing = frame.spacing_mm;
  const double z = k * spacing.z;
  for (const RoundCone& cone : cones_) {
    if (z < cone.low().z || z > cone.high().z) {
      continue;
    }
    const Range columns = voxels_between(cone.low().x, cone.high().x, spacing.x, frame.size[0]);
    const Range rows = voxels_between(cone.low().y, cone.high().y, spacing.y, frame.size[1]);
    for (int j = rows.low; j <= rows.high; ++j) {
      PaintedVoxel* row = slice + static_cast<std::size_t>(j) * static_cast<std::size_t>(frame.size[0]);
      for (int i = columns.low; i <= columns.high; ++i) {
        if (row[i] != material && cone.distance_mm(frame.local_centre(i, j, k)) <= 0) {
          row[i] = material;
        }
      }
    }
  }
}

std::vector<Knot> smooth_path(const std::vector<Knot>& knots, int pieces) {
  std::vector<Knot> path;
  const std::size_t last = knots.size() - 1;
  for (std::size_t span = 0; span < last; ++span) {
    const Vec3 &b = knots[span].at, &c = knots[span + 1].at;
    const Vec3 a = span > 0 ? knots[span - 1].at : 2 * b - c;
    const Vec3 d = span + 2 <= last ? knots[span + 2].at : 2 * c - b;
    for (int piece = 0; piece < pieces; ++piece) {
      const double t = static_cast<double>(piece) / pieces;
      path.push_back({catmull_rom(a, b, c, d, t),
                      knots[span].radius_mm + t * (knots[span + 1].radius_mm - knots[span].radius_mm)});
    }
  }
  path.push_back(knots.back());
  return path;
}

}  // namespace cbc3d::cases
