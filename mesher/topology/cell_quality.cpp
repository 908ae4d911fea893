#include "mesher/topology/cell_quality.hpp"

#include <algorithm>
#include <cstdint>

#include "mesher/core/float4.hpp"

namespace cbc3d {
namespace {

/// det(a, b, c) / (|a| |b| |c|), 0 when an edge has no length.
double scaled_det(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double lengths = std::sqrt(a.squared_norm() * b.squared_norm() * c.squared_norm());
  return lengths > 0 ? a.cross(b).dot(c) / lengths : 0;
}

// With floats, where no face is slimmer than this (the square of its height over its length), cosines are
// right to the margin, with room to spare.
constexpr float kSlimmest = 1e-6F;
constexpr double kFloatMargin = 1e-3;

float sum_xyz(const Float4& a) {
  return a[0] + a[1] + a[2];
}

/// x |x| of every lane.
Float4 signed_square(const Float4& x) {
  const Float4 square = x * x;
  return Float4(x.lanes < 0 ? -square.lanes : square.lanes);
}

/// Four vectors, a lane each.
struct FourVectors {
  Float4 x, y, z;

  FourVectors(const Float4& a, const Float4& b, const Float4& c, const Float4& d)
      : FourVectors(__builtin_shufflevector(a.lanes, b.lanes, 0, 4, 1, 5),
                    __builtin_shufflevector(c.lanes, d.lanes, 0, 4, 1, 5),
                    __builtin_shufflevector(a.lanes, b.lanes, 2, 6, 2, 6),
                    __builtin_shufflevector(c.lanes, d.lanes, 2, 6, 2, 6)) {}

  template <int A, int B, int C, int D>
  [[nodiscard]] FourVectors reordered() const {
    return {reorder<A, B, C, D>(x), reorder<A, B, C, D>(y), reorder<A, B, C, D>(z)};
  }
  [[nodiscard]] Float4 dot(const FourVectors& o) const { return x * o.x + y * o.y + z * o.z; }

 private:
  FourVectors(const Float4& x4, const Float4& y4, const Float4& z4) : x(x4), y(y4), z(z4) {}
  FourVectors(Float4::Lanes ab_xy, Float4::Lanes cd_xy, Float4::Lanes ab_z, Float4::Lanes cd_z)
      : x(__builtin_shufflevector(ab_xy, cd_xy, 0, 1, 4, 5)),
        y(__builtin_shufflevector(ab_xy, cd_xy, 2, 3, 6, 7)),
        z(__builtin_shufflevector(ab_z, cd_z, 0, 1, 4, 5)) {}
};

/// The three neighbours of each hex corner, right-handed.
constexpr std::array<std::array<std::uint8_t, 3>, 8> kHexCornerNeighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

}  // namespace

double max_dihedral_cosine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ad = d - a;
  const Vec3 base = ab.cross(ac);
  if (!(base.dot(ad) > 0)) {
    return 2;
  }
  const std::array<Vec3, 4> n = {(d - b).cross(c - b), ac.cross(ad), ad.cross(ab), base};
  std::array<double, 4> square{};
  for (std::size_t i = 0; i < 4; ++i) {
    square[i] = n[i].squared_norm();
  }
  // Inward normals of two faces at angle t have cosine -cos t. Signed squares spare the roots.
  double largest = -1;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double dot = -n[i].dot(n[j]);
      const double signed_square = dot * std::fabs(dot) / (square[i] * square[j]);
      largest = signed_square > largest ? signed_square : largest;  // std::fmax is a call
    }
  }
  return std::copysign(std::sqrt(std::fabs(largest)), largest);
}

bool surely_no_cosine_above(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double cosine) {
  const Float4 ab(b - a);
  const Float4 ac(c - a);
  const Float4 ad(d - a);
  const Float4 base = cross(ab, ac);
  const Float4 n1 = cross(ac, ad);
  const Float4 n2 = cross(ad, ab);
  const Float4 n0 = Float4(0.0F) - (n1 + n2 + base);  // the faces of a closed surface add up to nothing
  const FourVectors n(n0, n1, n2, base);
  const Float4 square = n.dot(n);
  const Float4 dot_next = n.dot(n.reordered<1, 2, 3, 0>());      // 01, 12, 23, 30
  const Float4 dot_opposite = n.dot(n.reordered<2, 3, 0, 1>());  // 02, 13, and again
  // A dihedral angle's cosine is minus that of the normals: signed squares spare the roots.
  const auto bound = static_cast<float>(-cosine * cosine * (1 - kFloatMargin));
  const Float4 lengths(sum_xyz(ab * ab) + sum_xyz(ac * ac) + sum_xyz(ad * ad));
  return sum_xyz(base * ad) > 0 && !any_greater(kSlimmest * (lengths * lengths), square) &&
         !any_greater(bound * (square * reorder<1, 2, 3, 0>(square)), signed_square(dot_next)) &&
         !any_greater(bound * (square * reorder<2, 3, 0, 1>(square)), signed_square(dot_opposite));
}

double min_dihedral_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double cosine = max_dihedral_cosine(a, b, c, d);
  return cosine > 1 ? 0 : std::acos(std::fmin(1, cosine)) * 180 / std::numbers::pi;
}

double scaled_jacobian_pyramid(std::span<const Vec3, 5> p) {
  double smallest = 1;
  for (std::size_t n = 0; n < 4; ++n) {
    smallest = std::fmin(smallest, std::numbers::sqrt3 *
                                       scaled_det(p[(n + 1) % 4] - p[n], p[(n + 3) % 4] - p[n], p[4] - p[n]));
  }
  return smallest;
}

double scaled_jacobian_hex(std::span<const Vec3, 8> p) {
  double smallest = scaled_det((p[1] + p[2] + p[5] + p[6]) - (p[0] + p[3] + p[4] + p[7]),
                               (p[2] + p[3] + p[6] + p[7]) - (p[0] + p[1] + p[4] + p[5]),
                               (p[4] + p[5] + p[6] + p[7]) - (p[0] + p[1] + p[2] + p[3]));
  for (std::size_t n = 0; n < 8; ++n) {
    const auto& near = kHexCornerNeighbours[n];
    smallest = std::fmin(smallest, scaled_det(p[near[0]] - p[n], p[near[1]] - p[n], p[near[2]] - p[n]));
  }
  return smallest;
}

}  // namespace cbc3d
