// Three-vectors and 3x3 matrices. Eigen's would do, but ITK's headers carry an older Eigen under the same
// names and the two cannot meet in one translation unit; these few lines also keep compile times and debug
// builds quick.
#pragma once

#include <array>
#include <cmath>

namespace cbc3d {

using Index3 = std::array<int, 3>;

struct Vec3 {
  double x = 0, y = 0, z = 0;

  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const double& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  Vec3& operator+=(const Vec3& o) { return x += o.x, y += o.y, z += o.z, *this; }
  Vec3& operator-=(const Vec3& o) { return x -= o.x, y -= o.y, z -= o.z, *this; }
  Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
  Vec3& operator/=(double s) { return *this *= 1 / s; }
  bool operator==(const Vec3&) const = default;

  [[nodiscard]] double dot(const Vec3& o) const { return x * o.x + y * o.y + z * o.z; }
  [[nodiscard]] Vec3 cross(const Vec3& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
  [[nodiscard]] double squared_norm() const { return dot(*this); }
  [[nodiscard]] double norm() const { return std::sqrt(squared_norm()); }
  [[nodiscard]] Vec3 normalized() const {
    const double n = norm();
    return n > 0 ? Vec3{x / n, y / n, z / n} : Vec3{};
  }
  [[nodiscard]] double min_coeff() const { return std::fmin(x, std::fmin(y, z)); }
  [[nodiscard]] double max_coeff() const { return std::fmax(x, std::fmax(y, z)); }
  [[nodiscard]] bool all_finite() const { return std::isfinite(x) && std::isfinite(y) && std::isfinite(z); }
};

inline Vec3 operator+(Vec3 a, const Vec3& b) {
  return a += b;
}
inline Vec3 operator-(Vec3 a, const Vec3& b) {
  return a -= b;
}
inline Vec3 operator-(const Vec3& a) {
  return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(Vec3 a, double s) {
  return a *= s;
}
inline Vec3 operator*(double s, Vec3 a) {
  return a *= s;
}
inline Vec3 operator/(Vec3 a, double s) {
  return a /= s;
}

/// Row-major 3x3 matrix.
struct Mat3 {
  std::array<Vec3, 3> rows{};

  static Mat3 identity() { return {{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}}; }
  static Mat3 from_columns(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{Vec3{a.x, b.x, c.x}, Vec3{a.y, b.y, c.y}, Vec3{a.z, b.z, c.z}}};
  }
  double& operator()(int row, int column) { return rows[static_cast<std::size_t>(row)][column]; }
  const double& operator()(int row, int column) const { return rows[static_cast<std::size_t>(row)][column]; }
  bool operator==(const Mat3&) const = default;

  [[nodiscard]] Vec3 column(int c) const { return {rows[0][c], rows[1][c], rows[2][c]}; }
  [[nodiscard]] Mat3 transposed() const { return from_columns(rows[0], rows[1], rows[2]); }
  [[nodiscard]] double determinant() const { return rows[0].dot(rows[1].cross(rows[2])); }
};

inline Vec3 operator*(const Mat3& m, const Vec3& v) {
  return {m.rows[0].dot(v), m.rows[1].dot(v), m.rows[2].dot(v)};
}
inline Mat3 operator*(const Mat3& a, const Mat3& b) {
  return Mat3::from_columns(a * b.column(0), a * b.column(1), a * b.column(2));
}

}  // namespace cbc3d
