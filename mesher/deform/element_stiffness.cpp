#include "mesher/deform/element_stiffness.hpp"

#include <cmath>

namespace cbc3d {
namespace {

constexpr std::size_t kGaussPoints = 8;

/// Derivatives of the shape functions by the cube's coordinates at the 2x2x2 Gauss points, all weights 1.
using Derivatives = std::array<std::array<Vec3, 8>, kGaussPoints>;

constexpr std::array<std::array<int, 3>, 8> kHexCorner = {
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};

Derivatives hex_derivatives() {
  const double g = 1 / std::sqrt(3.0);
  Derivatives d{};
  for (std::size_t q = 0; q < kGaussPoints; ++q) {
    const Vec3 at = {g * kHexCorner[q][0], g * kHexCorner[q][1], g * kHexCorner[q][2]};
    for (std::size_t n = 0; n < 8; ++n) {
      const auto& c = kHexCorner[n];
      const double x = 1 + at.x * c[0];
      const double y = 1 + at.y * c[1];
      const double z = 1 + at.z * c[2];
      d[q][n] = {c[0] * y * z / 8, x * c[1] * z / 8, x * y * c[2] / 8};
    }
  }
  return d;
}

Derivatives pyramid_derivatives() {
  Derivatives d = hex_derivatives();
  for (auto& point : d) {
    point[4] += point[5] + point[6] + point[7];
  }
  return d;
}

/// row[n] += w (lambda ga gb^T + mu gb ga^T + mu (ga . gb) I), b = n.
void add_block(const Vec3& ga, const Vec3& gb, double w, const LameConstants& lame, StiffnessBlock& block) {
  const double lambda = w * lame.lambda;
  const double mu = w * lame.mu;
  const double diagonal = mu * ga.dot(gb);
  block[0] += (lambda + mu) * ga.x * gb.x + diagonal;
  block[1] += lambda * ga.x * gb.y + mu * gb.x * ga.y;
  block[2] += lambda * ga.x * gb.z + mu * gb.x * ga.z;
  block[3] += lambda * ga.y * gb.x + mu * gb.y * ga.x;
  block[4] += (lambda + mu) * ga.y * gb.y + diagonal;
  block[5] += lambda * ga.y * gb.z + mu * gb.y * ga.z;
  block[6] += lambda * ga.z * gb.x + mu * gb.z * ga.x;
  block[7] += lambda * ga.z * gb.y + mu * gb.z * ga.y;
  block[8] += (lambda + mu) * ga.z * gb.z + diagonal;
}

void tet_row(std::span<const Vec3> p, std::size_t own, const LameConstants& lame,
             std::span<StiffnessBlock* const> row) {
  const Vec3 a = p[1] - p[0];
  const Vec3 b = p[2] - p[0];
  const Vec3 c = p[3] - p[0];
  const Vec3 bc = b.cross(c);
  const double det = a.dot(bc);
  if (!(det > 0)) {
    return;
  }
  std::array<Vec3, 4> g;  // times det
  g[1] = bc;
  g[2] = c.cross(a);
  g[3] = a.cross(b);
  g[0] = -(g[1] + g[2] + g[3]);
  const double weight = 1 / (6 * det);
  for (std::size_t n = 0; n < 4; ++n) {
    if (row[n] != nullptr) {
      add_block(g[own], g[n], weight, lame, *row[n]);
    }
  }
}

void quadrature_row(std::span<const Vec3> p, std::size_t own, const LameConstants& lame,
                    const Derivatives& derivatives, std::span<StiffnessBlock* const> row) {
  for (const auto& d : derivatives) {
    std::array<Vec3, 3> column{};  // dx/dxi, dx/deta, dx/dzeta
    for (std::size_t n = 0; n < p.size(); ++n) {
      column[0] += d[n].x * p[n];
      column[1] += d[n].y * p[n];
      column[2] += d[n].z * p[n];
    }
    const std::array<Vec3, 3> cofactor = {column[1].cross(column[2]), column[2].cross(column[0]),
                                          column[0].cross(column[1])};
    const double det = column[0].dot(cofactor[0]);
    if (!(det > 0)) {
      continue;
    }
    const auto gradient = [&](std::size_t n) {  // times det
      return d[n].x * cofactor[0] + d[n].y * cofactor[1] + d[n].z * cofactor[2];
    };
    const Vec3 ga = gradient(own);
    for (std::size_t n = 0; n < p.size(); ++n) {
      if (row[n] != nullptr) {
        add_block(ga, gradient(n), 1 / det, lame, *row[n]);
      }
    }
  }
}

}  // namespace

LameConstants lame_constants(const ElasticMaterial& material) {
  const double young = material.young_pa * 1e-6;
  const double nu = material.poisson;
  return {young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))};
}

TetGradients tet_gradients(const Vec3& p0, const Vec3& p1, const Vec3& p2, const Vec3& p3, double mu) {
  const Float4 a(p1 - p0);
  const Float4 b(p2 - p0);
  const Float4 c(p3 - p0);
  const Float4 bc = cross(b, c);
  const Float4 products = a * bc;
  const float det = products[0] + products[1] + products[2];
  if (!(det > 0)) {
    return {Float4(0.0F), Float4(0.0F), Float4(0.0F)};
  }
  const float scale = std::sqrt(static_cast<float>(mu) / (6 * det));
  return {scale * bc, scale * cross(c, a), scale * cross(a, b)};
}

void add_element_stiffness_row(std::span<const Vec3> points, std::size_t own, const LameConstants& lame,
                               std::span<StiffnessBlock* const> row) {
  static const Derivatives kHex = hex_derivatives();
  static const Derivatives kPyramid = pyramid_derivatives();
  if (points.size() == 4) {
    tet_row(points, own, lame, row);
  } else {
    quadrature_row(points, own, lame, points.size() == 5 ? kPyramid : kHex, row);
  }
}

}  // namespace cbc3d
