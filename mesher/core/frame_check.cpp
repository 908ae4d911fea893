#include "mesher/core/frame_check.hpp"

#include <cmath>
#include <cstdio>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr double kRounding = 1e-4, kMostShear = 1e-3, kSingular = 1e-2;
constexpr double kMostAnisotropy = 1000;

std::string text_of(const char* format, double a, double b = 0) {
  char text[300];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

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

/// The largest cosine of an angle between two axes, by its size.
double shear_of(const Mat3& direction) {
  const Vec3 x = direction.column(0).normalized(), y = direction.column(1).normalized(),
             z = direction.column(2).normalized();
  return std::fmax(std::fabs(x.dot(y)), std::fmax(std::fabs(y.dot(z)), std::fabs(z.dot(x))));
}

void orthonormalise(ImageFrame& frame) {
  const Vec3 x = frame.direction.column(0).normalized();
  const Vec3 second = frame.direction.column(1);
  const Vec3 y = (second - x * x.dot(second)).normalized();
  const Vec3 z = x.cross(y);
  frame.direction = Mat3::from_columns(x, y, frame.left_handed() ? -z : z);
}

/// The transposed inverse of a matrix: its columns are the cross products of the others over the determinant.
Mat3 inverse_transposed(const Mat3& m) {
  const Vec3 a = m.column(0), b = m.column(1), c = m.column(2);
  const double determinant = a.dot(b.cross(c));
  return Mat3::from_columns(b.cross(c) / determinant, c.cross(a) / determinant, a.cross(b) / determinant);
}

/// The orthogonal factor of the polar decomposition by Newton's iteration, which converges quadratically.
Mat3 nearest_orthogonal(Mat3 m) {
  for (int step = 0; step < 60 && distance_from_orthonormal(m) > 1e-15; ++step) {
    const Mat3 inverse = inverse_transposed(m);
    for (std::size_t row = 0; row < 3; ++row) {
      m.rows[row] = 0.5 * (m.rows[row] + inverse.rows[row]);
    }
  }
  return m;
}

/// The nearest orthogonal frame with the same centre; returns how far it moves a corner's voxel, mm.
double straighten(ImageFrame& frame) {
  const auto& size = frame.size;
  const Vec3 half = 0.5 * frame.local_centre(size[0] - 1, size[1] - 1, size[2] - 1);
  const Mat3 sheared = frame.direction;
  frame.origin_mm += sheared * half;
  frame.direction = nearest_orthogonal(Mat3::from_columns(
      sheared.column(0).normalized(), sheared.column(1).normalized(), sheared.column(2).normalized()));
  frame.origin_mm -= frame.direction * half;
  double moved_mm = 0;
  for (const Vec3& corner :
       {half, Vec3{-half.x, half.y, half.z}, Vec3{half.x, -half.y, half.z}, Vec3{half.x, half.y, -half.z}}) {
    moved_mm = std::fmax(moved_mm, (sheared * corner - frame.direction * corner).norm());
  }
  return moved_mm;
}

void require_spacing(const ImageFrame& frame, const std::string& subject) {
  const Vec3& s = frame.spacing_mm;
  if (!(s.min_coeff() > 0) || !s.all_finite() || !frame.origin_mm.all_finite()) {
    throw InputError(subject + ": its spacing or origin is not a positive finite number; correct it",
                     "spacing_mm");
  }
  if (s.max_coeff() > kMostAnisotropy * s.min_coeff()) {
    throw InputError(
        subject + text_of(": its voxels are %.4g times as long as thick, more than %.0f; correct the "
                          "spacing or resample it",
                          s.max_coeff() / s.min_coeff(), kMostAnisotropy),
        "spacing_mm");
  }
}

void require_direction(const ImageFrame& frame, const std::string& subject, bool accept_shear) {
  const Mat3& d = frame.direction;
  const double shear = shear_of(d);
  const Mat3 unit =
      Mat3::from_columns(d.column(0).normalized(), d.column(1).normalized(), d.column(2).normalized());
  if (!std::isfinite(distance_from_orthonormal(d)) || std::fabs(unit.determinant()) < kSingular) {
    throw InputError(subject + ": its direction matrix is singular; correct it", "direction");
  }
  if (shear > kMostShear && !accept_shear) {
    throw InputError(
        subject + text_of(": its axes are sheared by %.3g (two of them are %.4g degrees apart); "
                          "resample it to an orthogonal grid, or accept_shear takes the nearest one",
                          shear, std::acos(shear) * 180 / M_PI),
        "direction");
  }
  if (distance_from_orthonormal(d) > 2 * kMostShear && shear <= kMostShear) {
    throw InputError(subject + ": its direction matrix has a column that is not of length 1; correct it",
                     "direction");
  }
}

}  // namespace

void require_usable_frame(ImageFrame& frame, const std::string& subject, bool accept_shear,
                          std::vector<std::string>* warnings) {
  require_spacing(frame, subject);
  require_direction(frame, subject, accept_shear);
  const double distance = distance_from_orthonormal(frame.direction);
  if (distance > kRounding) {
    constexpr double kVoxels = 0.1;
    const double shear = shear_of(frame.direction);
    const double moved_mm = straighten(frame);
    if (warnings != nullptr && moved_mm > kVoxels * frame.spacing_mm.min_coeff()) {
      warnings->push_back(
          text_of("its axes are sheared by %.3g; the nearest orthogonal frame is taken, which moves "
                  "voxel centres by up to %.3g mm",
                  shear, moved_mm));
    }
  } else if (distance != 0) {  // a signed permutation is exact already
    orthonormalise(frame);
  }
}

}  // namespace cbc3d
