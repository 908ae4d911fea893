#include "mesher/quadratic/tet_jacobian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mesher/core/mesh.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {
namespace {

std::array<Vec3, 10> straight_tet() {
  std::array<Vec3, 10> nodes = {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}}};
  for (std::size_t e = 0; e < 6; ++e) {
    nodes[4 + e] = 0.5 * (nodes[kQuadraticTetEdges[e][0]] + nodes[kQuadraticTetEdges[e][1]]);
  }
  return nodes;
}

/// The determinant at a place, by the shape functions of the ten nodes and central differences.
double determinant_at(const std::array<Vec3, 10>& nodes, double r, double s, double t) {
  const auto map = [&](double x, double y, double z) {
    const std::array<double, 4> l = {1 - x - y - z, x, y, z};
    Vec3 sum;
    for (std::size_t corner = 0; corner < 4; ++corner) sum += l[corner] * (2 * l[corner] - 1) * nodes[corner];
    for (std::size_t e = 0; e < 6; ++e) {
      sum += 4 * l[kQuadraticTetEdges[e][0]] * l[kQuadraticTetEdges[e][1]] * nodes[4 + e];
    }
    return sum;
  };
  constexpr double kStep = 1e-4;
  const Vec3 x = (map(r + kStep, s, t) - map(r - kStep, s, t)) / (2 * kStep);
  const Vec3 y = (map(r, s + kStep, t) - map(r, s - kStep, t)) / (2 * kStep);
  const Vec3 z = (map(r, s, t + kStep) - map(r, s, t - kStep)) / (2 * kStep);
  return x.dot(y.cross(z));
}

TEST(TetJacobian, IsConstantInAStraightTet) {
  for (const double coefficient : jacobian_coefficients(straight_tet())) EXPECT_NEAR(coefficient, 6, 1e-12);
  EXPECT_NEAR(least_relative_jacobian(straight_tet()), 1, 1e-12);
  EXPECT_NEAR(volume_of_quadratic_tet(straight_tet()), 1, 1e-12);
}

TEST(TetJacobian, CoefficientsBoundItEverywhere) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.4, 0.4), place(0, 1);
  for (int n = 0; n < 50; ++n) {
    std::array<Vec3, 10> nodes = straight_tet();
    for (std::size_t e = 4; e < 10; ++e) nodes[e] += Vec3{shift(random), shift(random), shift(random)};
    const auto coefficients = jacobian_coefficients(nodes);
    const auto [least, most] = std::minmax_element(coefficients.begin(), coefficients.end());
    EXPECT_NEAR(coefficients.front(), determinant_at(nodes, 0, 0, 0), 1e-6) << "at corner 0";
    EXPECT_NEAR(coefficients.back(), determinant_at(nodes, 0, 0, 1), 1e-6) << "at corner 3";
    double sum = 0;
    int inside = 0;
    for (int k = 0; k < 400; ++k) {
      const double r = place(random), s = place(random), t = place(random);
      if (r + s + t > 1) continue;
      const double found = determinant_at(nodes, r, s, t);
      EXPECT_GE(found, *least - 1e-6);
      EXPECT_LE(found, *most + 1e-6);
      sum += found;
      ++inside;
    }
    EXPECT_NEAR(volume_of_quadratic_tet(nodes), sum / inside / 6, 0.5) << "sampled";
  }
}

TEST(TetJacobian, IsNegativeWhereATetIsInsideOut) {
  std::array<Vec3, 10> nodes = straight_tet();
  nodes[4] += Vec3{0, 1.5, 0};
  EXPECT_LT(least_relative_jacobian(nodes), 0);
  nodes = straight_tet();
  std::swap(nodes[1], nodes[2]);
  EXPECT_EQ(least_relative_jacobian(nodes), -1);
}

}  // namespace
}  // namespace cbc3d
