#include "mesher/core/frame_check.hpp"

#include <cmath>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

/// The largest entry of D^T D - I, by its size; infinite where an entry is not finite.
double distance_from_orthonormal(const Mat3& direction) {
  const Mat3 product = direction.transposed() * direction;
  double largest = 0;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const double entry = std::abs(product(row, column) - (row == column ? 1 : 0));
      largest = std::fmax(largest, std::isfinite(entry) ? entry : HUGE_VAL);
    }
  }
  return largest;
}

void orthonormalise(ImageFrame& frame) {
  const Vec3 x = frame.direction.column(0).normalized();
  const Vec3 second = frame.direction.column(1);
  const Vec3 y = (second - x * x.dot(second)).normalized();
  const Vec3 z = x.cross(y);
  frame.direction = Mat3::from_columns(x, y, frame.left_handed() ? -z : z);
}

}  // namespace

void require_usable_frame(ImageFrame& frame, const std::string& subject) {
  if (!(frame.spacing_mm.min_coeff() > 0) || !frame.spacing_mm.all_finite() ||
      !frame.origin_mm.all_finite()) {
    throw InputError(subject + ": its spacing or origin is not a positive finite number; correct it",
                     "spacing_mm");
  }
  constexpr double kRounding = 1e-3;
  const double distance = distance_from_orthonormal(frame.direction);
  if (distance > kRounding) {
    throw InputError(
        subject + ": its direction matrix is sheared or singular; resample it to an orthogonal grid",
        "direction");
  }
  if (distance != 0) {  // a signed permutation is exact already
    orthonormalise(frame);
  }
}

}  // namespace cbc3d
