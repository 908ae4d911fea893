// Where the boundary between two materials should lie, as the improver asks for it.
#pragma once

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// How far a point is from the boundary of materials a and b.
struct BoundarySample {
  double distance_mm = 0;   ///< signed estimate, positive on the side of a
  Vec3 normal;              ///< unit, towards a; zero where nothing is known
  double deviation_mm = 0;  ///< unsigned, for guards; infinite where no boundary is near
};

/// The boundaries that a mesh's interfaces are to follow. Thread-safe.
class Boundary {
 public:
  Boundary() = default;
  Boundary(const Boundary&) = delete;
  Boundary& operator=(const Boundary&) = delete;
  virtual ~Boundary() = default;

  /// The boundary between materials a and b near x (local mm); b may be background, which the outside is too.
  [[nodiscard]] virtual BoundarySample sample(const Vec3& x, MaterialId a, MaterialId b) const = 0;
};

}  // namespace cbc3d
