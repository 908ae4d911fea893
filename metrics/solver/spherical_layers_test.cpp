#include "metrics/solver/spherical_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/core/error.hpp"

namespace cbc3d::solver {
namespace {

/// The potential of a monopole in a sphere of radius 1 and conductivity 1, at its surface, less a constant:
/// the series summed, 2 / d + log(2 / (1 - x0 . s + d)), d the distance.
double monopole(const Vec3& place, const Vec3& direction) {
  const double d = (direction - place).norm();
  return (2 / d + std::log(2 / (1 - place.dot(direction) + d))) / (4 * std::numbers::pi);
}

TEST(DipolePotential, InOneLayerIsTheClosedForm) {
  const Vec3 place{.1, -.3, .5}, moment{.4, .2, -.7};
  const DipolePotential potential({1}, {1}, place, moment);
  for (const Vec3& towards : {Vec3{0, 0, 1}, {1, 0, 0}, {-.2, .5, .3}, {.3, -.7, -.9}}) {
    constexpr double kStep = 1e-5;
    const Vec3 s = towards.normalized();
    const double slope =
        (monopole(place + kStep * moment, s) - monopole(place - kStep * moment, s)) / (2 * kStep);
    EXPECT_NEAR(potential.at(s), slope, 1e-8);
  }
}

TEST(DipolePotential, InEqualLayersIsThatOfOne) {
  const Vec3 place{0, 30, 40}, moment{1, 2, 3};
  const DipolePotential one({92}, {.33}, place, moment), three({70, 80, 92}, {.33, .33, .33}, place, moment);
  for (const Vec3& s : {Vec3{0, 0, 1}, {1, 0, 0}, {0, -1, 0}}) {
    EXPECT_NEAR(three.at(s), one.at(s), 1e-12 * std::abs(one.at({0, .6, .8})));
  }
}

TEST(DipolePotential, ADipoleAtTheCentreHasACosine) {
  const DipolePotential potential({2}, {1}, {0, 0, 0}, {1, 0, 0});
  // Three times the dipole's own field in an endless medium.
  EXPECT_NEAR(potential.at({1, 0, 0}), 3 / (16 * std::numbers::pi), 1e-14);
  EXPECT_NEAR(potential.at({0, 1, 0}), 0, 1e-14);
}

TEST(DipolePotential, ADipoleOutsideTheInnermostLayerIsRefused) {
  EXPECT_THROW(DipolePotential({70, 80}, {1, 1}, {0, 0, 71}, {1, 0, 0}), InputError);
  EXPECT_THROW(require_nested({{1, 80}, {2, 70}}, 0), InputError);
  EXPECT_THROW(require_nested({}, 0), InputError);
}

TEST(PressurisedLayers, OneLayerIsLames) {
  const double a = 20, b = 40, young = 3, nu = .49, pressure = .1;
  const auto layers = pressurised_layers(a, pressure, {{b, young, nu}});
  const double common = pressure * a * a * a / (young * (b * b * b - a * a * a));
  EXPECT_NEAR(layers[0].a, common * (1 - 2 * nu), 1e-14);
  EXPECT_NEAR(layers[0].b, common * (1 + nu) * b * b * b / 2, 1e-9);
}

TEST(PressurisedLayers, EqualLayersAreOne) {
  const auto one = pressurised_layers(20, 1, {{40, 2, .3}}),
             two = pressurised_layers(20, 1, {{30, 2, .3}, {40, 2, .3}});
  for (const RadialDisplacement& layer : two) {
    EXPECT_NEAR(layer.a, one[0].a, 1e-12 * one[0].a);
    EXPECT_NEAR(layer.b, one[0].b, 1e-12 * one[0].b);
  }
}

}  // namespace
}  // namespace cbc3d::solver
