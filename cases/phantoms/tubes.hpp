// Tubes of varying radius: the convex hulls of two balls, strung along curves.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

/// A voxel while a phantom is painted: its material, which is its label too.
using PaintedVoxel = std::uint8_t;

/// A position on a curve and the radius there, mm.
struct Knot {
  Vec3 at;
  double radius_mm;
};

/// The convex hull of two balls.
class RoundCone {
 public:
  RoundCone(const Knot& from, const Knot& to);

  /// Signed distance, negative inside; exact.
  [[nodiscard]] double distance_mm(const Vec3& p) const;
  [[nodiscard]] const Vec3& low() const { return low_; }    ///< of the bounding box
  [[nodiscard]] const Vec3& high() const { return high_; }  ///< of the bounding box

 private:
  Vec3 from_, axis_;
  double from_radius_, to_radius_;
  double length2_, radius_drop_, slope2_, inverse_length2_;
  Vec3 low_, high_;
};

/// A union of round cones.
class Tubes {
 public:
  void add(const RoundCone& cone) { cones_.push_back(cone); }
  /// The cones between consecutive knots.
  void add_path(const std::vector<Knot>& knots);
  void add_ball(const Vec3& centre, double radius_mm) {
    add_path({{centre, radius_mm}, {centre, radius_mm}});
  }

  /// Least of the cones' signed distances: exact outside; inside exact unless cones overlap there, where the
  /// boundary is at least that far away.
  [[nodiscard]] double distance_mm(const Vec3& local_mm) const;
  /// Gives the voxels of slice k whose centres the tubes hold this material. `slice`: its size[0] * size[1]
  /// voxels.
  void paint(const ImageFrame& frame, int k, PaintedVoxel material, PaintedVoxel* slice) const;
  [[nodiscard]] const std::vector<RoundCone>& cones() const { return cones_; }

 private:
  std::vector<RoundCone> cones_;
};

/// A smooth curve through all knots (that of Catmull and Rom), `pieces`
/// steps from knot to knot; the radius changes linearly.
std::vector<Knot> smooth_path(const std::vector<Knot>& knots, int pieces);

}  // namespace cbc3d::cases
