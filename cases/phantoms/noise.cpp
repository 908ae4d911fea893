#include "cases/phantoms/noise.hpp"

#include <array>
#include <cmath>

#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double mixed(double a, double b, double t) {
  return a + t * (b - a);
}

/// The gradient at a lattice point (one of the twelve from a cube's centre to its edges) times `d`.
double gradient_dot(std::uint64_t seed, const std::array<std::int64_t, 3>& lattice, const Vec3& d) {
  const auto key = [](std::int64_t value, std::uint64_t factor) {
    return static_cast<std::uint64_t>(value) * factor;
  };
  const std::uint64_t bits =
      mix_bits(seed ^ key(lattice[0], 0x9E3779B185EBCA87ULL) ^ key(lattice[1], 0xC2B2AE3D27D4EB4FULL) ^
               key(lattice[2], 0x165667B19E3779F9ULL));
  const double a = (bits & 1U) != 0 ? 1 : -1, b = (bits & 2U) != 0 ? 1 : -1;
  switch ((bits >> 8U) % 3) {
    case 0:
      return a * d.x + b * d.y;
    case 1:
      return a * d.y + b * d.z;
    default:
      return a * d.z + b * d.x;
  }
}

}  // namespace

double gradient_noise(std::uint64_t seed, const Vec3& p) {
  const Vec3 base{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3 d = p - base;
  std::array<double, 8> corner{};
  for (unsigned c = 0; c < 8; ++c) {
    const int x = static_cast<int>(c & 1U), y = static_cast<int>(c >> 1U & 1U), z = static_cast<int>(c >> 2U);
    corner[c] = gradient_dot(seed,
                             {static_cast<std::int64_t>(base.x) + x, static_cast<std::int64_t>(base.y) + y,
                              static_cast<std::int64_t>(base.z) + z},
                             d - Vec3{double(x), double(y), double(z)});
  }
  const double u = fade(d.x), v = fade(d.y), w = fade(d.z);
  return mixed(mixed(mixed(corner[0], corner[1], u), mixed(corner[2], corner[3], u), v),
               mixed(mixed(corner[4], corner[5], u), mixed(corner[6], corner[7], u), v), w);
}

// Taylor's series within an eighth of a turn, where eight terms leave less than 1e-15.
CircleNumbers circle_at(double turns) {
  constexpr double kTwoPi = 6.283185307179586;
  constexpr int kTerms = 9;
  const double quarters = std::floor(4 * turns + 0.5);
  const double angle = kTwoPi * (turns - quarters / 4);
  const double square = angle * angle;
  double cosine = 1, sine = 1;
  for (int term = kTerms; term > 0; --term) {
    cosine = 1 - cosine * square / ((2 * term - 1) * (2 * term));
    sine = 1 - sine * square / ((2 * term) * (2 * term + 1));
  }
  sine *= angle;
  switch (static_cast<std::int64_t>(quarters) & 3) {
    case 0:
      return {cosine, sine};
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    default:
      return {sine, -cosine};
  }
}

}  // namespace cbc3d::cases
