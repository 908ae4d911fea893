// What the lattice is cut by: one indicator function for each material, the largest of which says which
// material is at a place (Bronson, Levine and Whitaker 2014, section 3).
#pragma once

#include "mesher/core/label_voxels.hpp"
#include "mesher/core/vec3.hpp"

namespace cbc3d::baselines::cleaver {

/// The indicator functions of all materials, at places in local mm.
class Indicators {
 public:
  virtual ~Indicators() = default;

  /// The material whose indicator is the largest, the lowest of equal ones.
  [[nodiscard]] virtual MaterialId material_at(const Vec3& place) const = 0;

  /// The fraction of the way from `from` to `to` at which material b's indicator overtakes material a's: 0
  /// where b's is not less at `from`, 1 where a's is not less at `to`.
  [[nodiscard]] virtual double crossing(const Vec3& from, const Vec3& to, MaterialId a,
                                        MaterialId b) const = 0;

  /// True beyond the image's box, where the exterior is.
  [[nodiscard]] virtual bool is_outside(const Vec3& place) const = 0;
};

}  // namespace cbc3d::baselines::cleaver
