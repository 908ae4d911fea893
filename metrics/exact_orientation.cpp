#include "metrics/exact_orientation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cbc3d::metrics {
namespace {

// Half the distance from 1 to the next double: the relative error of one operation.
constexpr double kUnit = 0x1p-53;

// A sum of doubles that do not overlap, ascending in magnitude and without zeros: its last part has its sign.
template <std::size_t kCapacity>
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < size_; ++n) {
      const double sum = value + parts_[n];
      const double of_part = sum - value;
      const double error = (value - (sum - of_part)) + (parts_[n] - of_part);
      if (error != 0) {
        parts_[kept++] = error;
      }
      value = sum;
    }
    if (value != 0) {
      parts_[kept++] = value;
    }
    size_ = kept;
  }
  template <std::size_t kOther>
  void add(const Expansion<kOther>& other, double factor = 1) {
    for (std::size_t n = 0; n < other.size(); ++n) {
      add(factor * other[n]);
    }
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] double operator[](std::size_t n) const { return parts_[n]; }
  [[nodiscard]] int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, kCapacity> parts_;
  std::size_t size_ = 0;
};

using Difference = Expansion<2>;

Difference difference(double a, double b) {
  Difference result;
  result.add(a);
  result.add(-b);
  return result;
}

template <std::size_t kA, std::size_t kB>
Expansion<2 * kA * kB> product(const Expansion<kA>& a, const Expansion<kB>& b) {
  Expansion<2 * kA * kB> result;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      const double rounded = a[i] * b[j];
      result.add(std::fma(a[i], b[j], -rounded));
      result.add(rounded);
    }
  }
  return result;
}

/// a d - b c.
Expansion<16> determinant(const Difference& a, const Difference& b, const Difference& c,
                          const Difference& d) {
  Expansion<16> result;
  result.add(product(a, d));
  result.add(product(b, c), -1);
  return result;
}

int exact_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  std::array<std::array<Difference, 3>, 3> rows;
  const std::array<const Vec3*, 3> corners{&b, &c, &d};
  for (std::size_t row = 0; row < 3; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      rows[row][static_cast<std::size_t>(axis)] = difference((*corners[row])[axis], a[axis]);
    }
  }
  Expansion<192> sum;
  for (std::size_t row = 0; row < 3; ++row) {
    const auto &u = rows[(row + 1) % 3], &v = rows[(row + 2) % 3];
    sum.add(product(determinant(u[0], u[1], v[0], v[1]), rows[row][2]));
  }
  return sum.sign();
}

int exact_orientation(const Point2& a, const Point2& b, const Point2& c) {
  return determinant(difference(b[0], a[0]), difference(b[1], a[1]), difference(c[0], a[0]),
                     difference(c[1], a[1]))
      .sign();
}

}  // namespace

int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kBound = (7 + 56 * kUnit) * kUnit;
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double uv = u.x * v.y, vu = u.y * v.x;
  const double vw = v.x * w.y, wv = v.y * w.x;
  const double wu = w.x * u.y, uw = w.y * u.x;
  const double value = w.z * (uv - vu) + u.z * (vw - wv) + v.z * (wu - uw);
  const double size = (std::fabs(uv) + std::fabs(vu)) * std::fabs(w.z) +
                      (std::fabs(vw) + std::fabs(wv)) * std::fabs(u.z) +
                      (std::fabs(wu) + std::fabs(uw)) * std::fabs(v.z);
  if (std::fabs(value) > kBound * size) {
    return value > 0 ? 1 : -1;
  }
  // Where every product has an exact zero, as in planes along the axes, the sum has no error at all.
  return size == 0 ? 0 : exact_orientation(a, b, c, d);
}

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  constexpr double kBound = (3 + 16 * kUnit) * kUnit;
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  const double value = left - right, size = std::fabs(left) + std::fabs(right);
  if (std::fabs(value) > kBound * size) {
    return value > 0 ? 1 : -1;
  }
  return size == 0 ? 0 : exact_orientation(a, b, c);
}

}  // namespace cbc3d::metrics
