// The shape of a brain: folded hemispheres, cerebellum and stem, and the ventricles within.
#pragma once

#include <cstdint>

#include "cases/phantoms/tubes.hpp"

namespace cbc3d::cases {

class BrainShape {
 public:
  /// A brain that fits an image of this extent, mm.
  BrainShape(const Vec3& extent_mm, std::uint64_t seed);

  /// True within brain tissue (the ventricles count as tissue).
  [[nodiscard]] bool holds(const Vec3& local_mm) const;
  /// A position given in the brain's own frame (mm for a brain of ordinary size; x to the left, y to the
  /// back, z up, from its middle) as a local position.
  [[nodiscard]] Vec3 place(const Vec3& anatomical) const { return middle_mm_ + scale_ * anatomical; }
  [[nodiscard]] double scale() const { return scale_; }  ///< mm a unit of the brain's own frame
  /// The lateral ventricles with their horns and the third ventricle between them.
  [[nodiscard]] Tubes ventricles(double thinnest_mm) const;

 private:
  [[nodiscard]] bool in_cerebrum(const Vec3& p) const;
  [[nodiscard]] bool in_cerebellum(const Vec3& p) const;

  Vec3 middle_mm_;
  double scale_;
  std::uint64_t seed_;
  RoundCone stem_;
};

}  // namespace cbc3d::cases
