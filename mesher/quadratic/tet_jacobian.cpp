#include "mesher/quadratic/tet_jacobian.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/core/mesh.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {
namespace {

/// The derivatives of the map towards corners 1, 2 and 3 are linear over the tet: their values at the four
/// corners.
using Gradients = std::array<std::array<Vec3, 4>, 3>;

/// By the quadratic map's Bézier points: corners as they are, of edges twice the node less the mean of the
/// ends.
Gradients gradients_of(const std::array<Vec3, 10>& nodes) {
  std::array<std::array<Vec3, 4>, 4> control;
  for (std::size_t corner = 0; corner < 4; ++corner) control[corner][corner] = nodes[corner];
  for (std::size_t e = 0; e < 6; ++e) {
    const auto [a, b] = kQuadraticTetEdges[e];
    control[a][b] = control[b][a] = 2 * nodes[4 + e] - 0.5 * (nodes[a] + nodes[b]);
  }
  Gradients gradients;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 3; ++i) gradients[i][k] = control[k][i + 1] - control[k][0];
    for (std::size_t i = 0; i < 3; ++i) gradients[i][k] *= 2;
  }
  return gradients;
}

/// A product of three linear forms has as its coefficient of corners a, b, c the mean over their orders.
double coefficient(const Gradients& g, std::array<std::size_t, 3> corners) {
  std::array<std::size_t, 3> order{0, 1, 2};
  double sum = 0;
  do {
    sum += g[0][corners[order[0]]].dot(g[1][corners[order[1]]].cross(g[2][corners[order[2]]]));
  } while (std::next_permutation(order.begin(), order.end()));
  return sum / 6;
}

}  // namespace

std::array<double, 20> jacobian_coefficients(const std::array<Vec3, 10>& nodes) {
  const Gradients gradients = gradients_of(nodes);
  std::array<double, 20> coefficients{};
  std::size_t n = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a; b < 4; ++b) {
      for (std::size_t c = b; c < 4; ++c) coefficients[n++] = coefficient(gradients, {a, b, c});
    }
  }
  return coefficients;
}

double least_relative_jacobian(const std::array<Vec3, 10>& nodes) {
  const double straight = six_volumes(nodes[0], nodes[1], nodes[2], nodes[3]);
  if (!(straight > 0)) return -1;
  const auto coefficients = jacobian_coefficients(nodes);
  return *std::min_element(coefficients.begin(), coefficients.end()) / straight;
}

double volume_of_quadratic_tet(const std::array<Vec3, 10>& nodes) {
  const auto coefficients = jacobian_coefficients(nodes);
  return std::accumulate(coefficients.begin(), coefficients.end(), 0.0) / 20 / 6;
}

}  // namespace cbc3d
