// Four floats in a register, for kernels that read 3-vectors by the million: compilers for x86-64 and ARM
// turn each operation into one instruction without any flag for a certain processor. What lane 3
// holds has no meaning.
#pragma once

#include <cstring>

#include "mesher/core/vec3.hpp"

namespace cbc3d {

struct alignas(16) Float4 {
  using Lanes = float __attribute__((vector_size(16)));
  Lanes lanes;

  Float4() = default;  ///< as with a float, `Float4 a;` is not set and `Float4 a{};` is zeros
  explicit Float4(Lanes l) : lanes(l) {}
  explicit Float4(float all) : lanes{all, all, all, all} {}
  Float4(float x, float y, float z, float w) : lanes{x, y, z, w} {}
  explicit Float4(const Vec3& v)
      : lanes{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0} {}

  /// Reads four floats, wherever they lie.
  static Float4 load(const float* from) {
    Float4 f;
    std::memcpy(&f.lanes, from, sizeof(f.lanes));
    return f;
  }
  /// Writes lanes 0 to 2.
  void store3(float* to) const { std::memcpy(to, &lanes, 3 * sizeof(float)); }

  float operator[](int lane) const { return lanes[lane]; }
  [[nodiscard]] Vec3 xyz() const { return {lanes[0], lanes[1], lanes[2]}; }

  Float4& operator+=(const Float4& o) { return lanes += o.lanes, *this; }
  Float4& operator-=(const Float4& o) { return lanes -= o.lanes, *this; }
};

inline Float4 operator+(const Float4& a, const Float4& b) {
  return Float4(a.lanes + b.lanes);
}
inline Float4 operator-(const Float4& a, const Float4& b) {
  return Float4(a.lanes - b.lanes);
}
inline Float4 operator*(const Float4& a, const Float4& b) {
  return Float4(a.lanes * b.lanes);
}
inline Float4 operator*(float s, const Float4& a) {
  return Float4(Float4(s).lanes * a.lanes);
}

/// A vector that has one lane of `a` in all lanes.
template <int Lane>
Float4 spread(const Float4& a) {
  return Float4(__builtin_shufflevector(a.lanes, a.lanes, Lane, Lane, Lane, Lane));
}

/// A vector with the lanes of `a` in another order.
template <int A, int B, int C, int D>
Float4 reorder(const Float4& a) {
  return Float4(__builtin_shufflevector(a.lanes, a.lanes, A, B, C, D));
}

/// The cross product of lanes 0 to 2; its lane 3 is zero where those of the vectors are finite.
inline Float4 cross(const Float4& a, const Float4& b) {
  return reorder<1, 2, 0, 3>(a * reorder<1, 2, 0, 3>(b) - reorder<1, 2, 0, 3>(a) * b);
}

/// True when a lane of a is greater than that of b.
inline bool any_greater(const Float4& a, const Float4& b) {
  const auto greater = a.lanes > b.lanes;
  return (greater[0] | greater[1] | greater[2] | greater[3]) != 0;
}

/// The rows of a 3x3 matrix from its columns, or the columns from its rows.
inline void transpose(const Float4 (&from)[3], Float4 (&to)[3]) {
  const auto a = __builtin_shufflevector(from[0].lanes, from[1].lanes, 0, 4, 1, 5);
  const auto b = __builtin_shufflevector(from[0].lanes, from[1].lanes, 2, 6, 2, 6);
  to[0] = Float4(__builtin_shufflevector(a, from[2].lanes, 0, 1, 4, 4));
  to[1] = Float4(__builtin_shufflevector(a, from[2].lanes, 2, 3, 5, 5));
  to[2] = Float4(__builtin_shufflevector(b, from[2].lanes, 0, 1, 6, 6));
}

}  // namespace cbc3d
