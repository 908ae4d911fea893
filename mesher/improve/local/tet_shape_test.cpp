// A tet's worst angle and its energy with derivatives, against angles by projection and finite differences.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

using testing::draw_point;

using Tet = std::array<Vec3, 4>;

const Tet kRegular = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

double six(const Tet& t) {
  return six_volumes(t[0], t[1], t[2], t[3]);
}

/// The dihedral angle at edge a, b between the half planes through c and d, by projection onto the plane
/// across the edge.
double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 along = (b - a).normalized();
  const Vec3 p = (c - a) - (c - a).dot(along) * along;
  const Vec3 q = (d - a) - (d - a).dot(along) * along;
  return std::atan2(p.cross(q).norm(), p.dot(q));
}

double smallest_sine_squared(const Tet& t) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kEdges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  double smallest = 1;
  for (const auto& e : kEdges) {
    const double sine = std::sin(dihedral(t[e[0]], t[e[1]], t[e[2]], t[e[3]]));
    smallest = std::min(smallest, sine * sine);
  }
  return smallest;
}

TEST(TetShape, WorstSineIsThatOfTheDihedralAngles) {
  std::mt19937 random(1);
  int positive = 0;
  for (int i = 0; i < 2000; ++i) {
    Tet t;
    for (Vec3& p : t) {
      p = draw_point(random, -3, 3);
      p.z *= i % 2 == 0 ? 1 : 0.05;  // flat ones too
    }
    const double got = min_sine_squared(t[0], t[1], t[2], t[3]);
    const double mirrored = min_sine_squared(t[0], t[2], t[1], t[3]);
    EXPECT_NEAR(six(t) > 0 ? got : mirrored, smallest_sine_squared(t), 1e-9);
    EXPECT_EQ(six(t) > 0 ? mirrored : got, -1);
    EXPECT_NEAR(std::max(got, mirrored),
                std::max(min_sine_squared(t[1], t[3], t[2], t[0]), min_sine_squared(t[1], t[2], t[3], t[0])),
                1e-9);
    positive += six(t) > 0 ? 1 : 0;
  }
  EXPECT_GT(positive, 500);
  EXPECT_LT(positive, 1500);
}

TEST(TetShape, RegularAndFlatTets) {
  const double orientation = six(kRegular);
  const Tet t = orientation > 0 ? kRegular : Tet{kRegular[0], kRegular[2], kRegular[1], kRegular[3]};
  EXPECT_NEAR(min_sine_squared(t[0], t[1], t[2], t[3]), 8.0 / 9, 1e-12);  // the angle's cosine is 1/3
  EXPECT_NEAR(quality_of_deg(std::acos(1.0 / 3) * 180 / std::numbers::pi), 8.0 / 9, 1e-12);
  EXPECT_NEAR(quality_of_deg(20), quality_of_deg(160), 1e-12);
  EXPECT_NEAR(shape_energy(t[0], t[1], t[2], t[3]), 1, 1e-12);
  EXPECT_NEAR(shape_energy(7 * t[0], 7 * t[1], 7 * t[2], 7 * t[3]), 1, 1e-12);  // of any size
  EXPECT_LT(shape_energy(t[0], t[2], t[1], t[3]), 0);
  const Vec3 flat = (t[0] + t[1] + t[2]) / 3;
  EXPECT_EQ(min_sine_squared(t[0], t[0], t[2], t[3]), -1);
  EXPECT_LT(shape_energy(t[0], t[1], t[2], t[0]), 0);
  EXPECT_LT(min_sine_squared(t[0], t[1], t[2], flat), 1e-20);
}

TEST(TetShape, EnergyIsLeastForTheRegularTet) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    Tet t;
    for (Vec3& p : t) p = draw_point(random, -1, 1);
    if (six(t) > 0) {
      EXPECT_GE(shape_energy(t[0], t[1], t[2], t[3]), 1 - 1e-12);
    }
  }
}

double product(const std::array<double, 6>& h, const Vec3& v) {  // v' H v
  return h[0] * v.x * v.x + h[1] * v.y * v.y + h[2] * v.z * v.z +
         2 * (h[3] * v.x * v.y + h[4] * v.x * v.z + h[5] * v.y * v.z);
}

TEST(TetShape, GradientIsThatOfFiniteDifferencesAndTheHessianIsPositive) {
  std::mt19937 random(3);
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    Tet t;
    for (Vec3& p : t) p = draw_point(random, -1, 1);
    ShapeTerm term;
    const double energy = shape_energy(t[0], t[1], t[2], t[3]);
    ASSERT_EQ(add_shape_term(t[0], t[1], t[2], t[3], term), six(t) > 0);
    if (!(six(t) > 0.1)) {
      continue;
    }
    ++checked;
    EXPECT_NEAR(term.energy, energy, 1e-10 * energy);
    const Vec3 n = draw_point(random, -1, 1).normalized();
    add_plane_term(n, 0.3, 20, term);
    const auto total = [&](const Vec3& x) {
      const double offset = 0.3 + n.dot(x - t[0]);
      return shape_energy(x, t[1], t[2], t[3]) + 10 * offset * offset;
    };
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 low = t[0];
      Vec3 high = t[0];
      low[axis] -= kStep;
      high[axis] += kStep;
      const double slope = (total(high) - total(low)) / (2 * kStep);
      EXPECT_NEAR(term.gradient[axis], slope, 1e-4 * (1 + term.gradient.norm()));
    }
    EXPECT_GT(product(term.hessian, draw_point(random, -1, 1)), 0);
    const Vec3 step = newton_step(term);
    EXPECT_LT(step.dot(term.gradient), 0);  // downhill
    EXPECT_LT(total(t[0] + 1e-4 * step), total(t[0]));
    // H step = -g, seen through an arbitrary direction.
    const Vec3 w = draw_point(random, -1, 1);
    const double across = 0.25 * (product(term.hessian, step + w) - product(term.hessian, step - w));
    EXPECT_NEAR(across, -term.gradient.dot(w), 1e-6 * (1 + term.gradient.norm()));
  }
  EXPECT_GT(checked, 100);
  EXPECT_EQ(newton_step(ShapeTerm{1, {1, 2, 3}, {}}), (Vec3{}));  // singular
}

TEST(TetQuality, IsTheSmallerOfAngleAndMeanRatio) {
  // The regular tet: a mean ratio of 1, angles of 70.5 degrees.
  EXPECT_NEAR(tet_quality({1, 1, 1}, {1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}), kMeanRatioShare, 1e-12);
  EXPECT_EQ(tet_quality({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}), -1);  // inside out
  // A flat one is bad by its angles.
  const Vec3 top = {0, 0, 0.01};
  EXPECT_EQ(tet_quality({1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, top),
            min_sine_squared({1, 0, 0}, {-0.5, 0.8, 0}, {-0.5, -0.8, 0}, top));
  // A long one is bad by its mean ratio, though no angle is below 50 degrees.
  const std::array<Vec3, 4> needle = {Vec3{1, 0, 0}, Vec3{-0.5, std::sqrt(0.75), 0},
                                      Vec3{-0.5, -std::sqrt(0.75), 0}, Vec3{0, 0, 30}};
  EXPECT_GT(min_sine_squared(needle[0], needle[1], needle[2], needle[3]), quality_of_deg(50));
  EXPECT_LT(tet_quality(needle[0], needle[1], needle[2], needle[3]), quality_of_deg(10));
}

TEST(TetQuality, ItsSecondTermIsTheMeanRatioToThePowerOneAndAHalf) {
  const std::array<Vec3, 4> tet = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 6}};
  const double volume = 1;
  const double edges = 1 + 1 + 36 + 2 + 37 + 37;
  const double mean_ratio = 12 * std::pow(3 * volume, 2.0 / 3) / edges;
  EXPECT_NEAR(tet_quality(tet[0], tet[1], tet[2], tet[3]), kMeanRatioShare * std::pow(mean_ratio, 1.5),
              1e-12);
}

TEST(TetQuality, IsTheSmallestOfItsThreeTermsAndEachOfThemDecidesSomewhere) {
  std::mt19937 random(3);
  std::array<int, 3> decides{};
  for (int i = 0; i < 4000; ++i) {
    Tet t;
    for (Vec3& p : t) p = draw_point(random, -1, 1);
    if (six(t) <= 0) std::swap(t[0], t[1]);
    double edges = 0;
    double shortest = 1e9;
    double longest = 0;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double length = (t[a] - t[b]).norm();
        edges += length * length;
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
      }
    }
    const double mean_ratio = 12 * std::pow(0.5 * six(t), 2.0 / 3) / edges;
    const std::array<double, 3> terms = {smallest_sine_squared(t),
                                         kMeanRatioShare * std::pow(mean_ratio, 1.5),
                                         kEdgeRatioShare * std::pow(shortest / longest, 2)};
    const auto* least = std::min_element(terms.begin(), terms.end());
    ++decides[static_cast<std::size_t>(least - terms.begin())];
    EXPECT_NEAR(tet_quality(t[0], t[1], t[2], t[3]), *least, 1e-9);
  }
  for (const int count : decides) EXPECT_GT(count, 10);
}

}  // namespace
}  // namespace cbc3d
