#include "metrics/solver/spherical_layers.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "mesher/core/error.hpp"
#include "metrics/solver/manufactured.hpp"

namespace cbc3d::solver {

namespace {

/// The potential of degree n at the outer surface, radius 1, for A, B in the innermost layer with B = 1.
/// Going outwards, with s the ratio of conductivities inner / outer and r the interface's radius, continuity
/// gives the next layer's
///   A' + B' r^-(2n+1) = A + B r^-(2n+1),  n A' - (n+1) B' r^-(2n+1) = s (n A - (n+1) B r^-(2n+1)).
/// A is unknown, so both are carried as (of A, of B); n A' = (n+1) B' at the surface fixes A.
double surface_potential(double n, const std::vector<double>& radii,
                         const std::vector<double>& conductivities) {
  struct Pair {
    double of_a, of_b;
  };
  Pair a{1, 0}, b{0, 1};
  for (std::size_t layer = 0; layer + 1 < radii.size(); ++layer) {
    const double power = std::pow(radii[layer] / radii.back(), 2 * n + 1);
    const double s = conductivities[layer] / conductivities[layer + 1];
    const auto next_a = [&](double ai, double bi) {
      return ((n + 1 + s * n) * ai + (n + 1) * (1 - s) * bi / power) / (2 * n + 1);
    };
    const auto next_b = [&](double ai, double bi) {
      return (n * (1 - s) * ai * power + (n + s * (n + 1)) * bi) / (2 * n + 1);
    };
    const Pair old_a = a, old_b = b;
    a = {next_a(old_a.of_a, old_b.of_a), next_a(old_a.of_b, old_b.of_b)};
    b = {next_b(old_a.of_a, old_b.of_a), next_b(old_a.of_b, old_b.of_b)};
  }
  // No current through the surface: n (a.of_a A + a.of_b) = (n + 1) (b.of_a A + b.of_b).
  const double of_a = n * a.of_a - (n + 1) * b.of_a;
  const double inner_a = ((n + 1) * b.of_b - n * a.of_b) / of_a;
  return (a.of_a + b.of_a) * inner_a + a.of_b + b.of_b;
}

}  // namespace

void require_nested(const std::vector<Layer>& layers, double inner_radius_mm) {
  if (layers.empty()) {
    throw InputError("a sphere needs its layers, from inside outwards: --layer LABEL=RADIUS_MM ...");
  }
  double radius = inner_radius_mm;
  for (const Layer& layer : layers) {
    if (!(layer.outer_radius_mm > radius)) {
      throw InputError("layer " + std::to_string(layer.label) + " of radius " +
                       std::to_string(layer.outer_radius_mm) +
                       " mm is not outside what comes before it; give the layers from inside outwards");
    }
    radius = layer.outer_radius_mm;
  }
}

DipolePotential::DipolePotential(const std::vector<double>& radii, const std::vector<double>& conductivities,
                                 const Vec3& place, const Vec3& moment)
    : towards_(place.norm() > 0 ? place.normalized() : Vec3{0, 0, 1}), moment_(moment) {
  if (!(place.norm() < radii.front())) {
    throw InputError("the dipole is " + std::to_string(place.norm()) +
                     " mm from the centre, not inside the innermost " + "layer of radius " +
                     std::to_string(radii.front()) + " mm");
  }
  constexpr std::size_t kMostTerms = 2000;
  constexpr double kLeastTerm = 1e-17;
  const double eccentricity = place.norm() / radii.back();
  const double unit = 1 / (4 * std::numbers::pi * conductivities.front() * radii.back() * radii.back());
  double power = 1;
  for (std::size_t n = 1; n <= kMostTerms && static_cast<double>(n * n) * power > kLeastTerm; ++n) {
    terms_.push_back(unit * power * surface_potential(static_cast<double>(n), radii, conductivities));
    power *= eccentricity;
  }
}

double DipolePotential::at(const Vec3& direction) const {
  const double t = direction.dot(towards_);
  const double along = moment_.dot(towards_), across = moment_.dot(direction) - t * along;
  // Legendre's polynomials and their derivatives, by Bonnet's recurrence.
  double before = 1, now = t, slope_before = 0, slope = 1, sum = 0;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const auto n = static_cast<double>(i + 1);
    sum += terms_[i] * (n * now * along + slope * across);
    const double next = ((2 * n + 1) * t * now - n * before) / (n + 1);
    const double next_slope = slope_before + (2 * n + 1) * now;
    before = now, now = next;
    slope_before = slope, slope = next_slope;
  }
  return sum;
}

std::vector<RadialDisplacement> pressurised_layers(double cavity_radius, double pressure,
                                                   const std::vector<ElasticLayer>& layers) {
  const auto count = static_cast<Eigen::Index>(layers.size());
  Eigen::MatrixXd conditions = Eigen::MatrixXd::Zero(2 * count, 2 * count);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(2 * count);
  // Radial stress (3 lambda + 2 mu) a - 4 mu b / r^3 of a layer, with a sign, into a row.
  const auto add_stress = [&](Eigen::Index row, Eigen::Index layer, double radius, double sign) {
    const ElasticLayer& elastic = layers[static_cast<std::size_t>(layer)];
    const Lame lame = lame_of(elastic.young, elastic.poisson_ratio);
    conditions(row, 2 * layer) = sign * (3 * lame.lambda + 2 * lame.mu);
    conditions(row, 2 * layer + 1) = -sign * 4 * lame.mu / std::pow(radius, 3);
  };
  add_stress(0, 0, cavity_radius, 1);
  right_side[0] = -pressure;
  for (Eigen::Index layer = 0; layer + 1 < count; ++layer) {
    const double radius = layers[static_cast<std::size_t>(layer)].outer_radius;
    add_stress(2 * layer + 1, layer, radius, 1);
    add_stress(2 * layer + 1, layer + 1, radius, -1);
    conditions(2 * layer + 2, 2 * layer) = 1;
    conditions(2 * layer + 2, 2 * layer + 1) = 1 / std::pow(radius, 3);
    conditions(2 * layer + 2, 2 * layer + 2) = -1;
    conditions(2 * layer + 2, 2 * layer + 3) = -1 / std::pow(radius, 3);
  }
  add_stress(2 * count - 1, count - 1, layers.back().outer_radius, 1);
  // Stresses and displacements differ by the modulus: each row is scaled to its largest entry.
  for (Eigen::Index row = 0; row < 2 * count; ++row) {
    const double most = conditions.row(row).cwiseAbs().maxCoeff();
    conditions.row(row) /= most;
    right_side[row] /= most;
  }
  const Eigen::VectorXd found = conditions.fullPivLu().solve(right_side);
  std::vector<RadialDisplacement> result;
  result.reserve(layers.size());
  for (Eigen::Index layer = 0; layer < count; ++layer) {
    result.push_back({found[2 * layer], found[2 * layer + 1]});
  }
  return result;
}

}  // namespace cbc3d::solver
