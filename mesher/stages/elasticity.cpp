#include "mesher/stages/elasticity.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {
namespace {

/// Gradients of the four linear shape functions and the volume of a tet.
struct TetGradients {
  std::array<Vec3, 4> gradient;
  double volume;
};

TetGradients gradients_of(const MaterialMesh& mesh, const std::array<VertexId, 4>& tet) {
  TetGradients g;
  const Vec3& p0 = mesh.points[tet[0]];
  const Vec3 a = mesh.points[tet[1]] - p0;
  const Vec3 b = mesh.points[tet[2]] - p0;
  const Vec3 c = mesh.points[tet[3]] - p0;
  const double det = a.cross(b).dot(c);
  g.volume = det / 6;
  g.gradient[1] = b.cross(c) / det;
  g.gradient[2] = c.cross(a) / det;
  g.gradient[3] = a.cross(b) / det;
  g.gradient[0] = -(g.gradient[1] + g.gradient[2] + g.gradient[3]);
  return g;
}

std::array<double, 9> inverse_of(const std::array<float, 9>& m) {
  const Vec3 r0{m[0], m[1], m[2]};
  const Vec3 r1{m[3], m[4], m[5]};
  const Vec3 r2{m[6], m[7], m[8]};
  const Vec3 c0 = r1.cross(r2);
  const Vec3 c1 = r2.cross(r0);
  const Vec3 c2 = r0.cross(r1);
  const double s = 1 / r0.dot(c0);
  return {c0.x * s, c1.x * s, c2.x * s, c0.y * s, c1.y * s, c2.y * s, c0.z * s, c1.z * s, c2.z * s};
}

template <typename Real>
Vec3 times(const std::array<Real, 9>& m, const Vec3& v) {
  return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
          m[6] * v.x + m[7] * v.y + m[8] * v.z};
}

/// Sum in fixed chunks, then over the chunks in order: the same bits at any thread count.
template <typename Term>
double ordered_sum(std::size_t count, const Term& term) {
  constexpr std::size_t kChunk = 2048;
  std::vector<double> partial((count + kChunk - 1) / kChunk);
#pragma omp parallel for schedule(static)
  for (std::size_t c = 0; c < partial.size(); ++c) {
    double sum = 0;
    for (std::size_t v = c * kChunk; v < std::min(count, (c + 1) * kChunk); ++v) {
      sum += term(v);
    }
    partial[c] = sum;
  }
  double total = 0;
  for (const double p : partial) {
    total += p;
  }
  return total;
}

double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return ordered_sum(a.size(), [&](std::size_t v) { return a[v].dot(b[v]); });
}

}  // namespace

ElasticSystem::ElasticSystem(const MaterialMesh& mesh, const ElasticityOptions& options)
    : options_(options), around_(tets_of_vertices(mesh.tets, mesh.points.size())) {
  const std::size_t count = mesh.points.size();
  first_.assign(count + 1, 0);
  std::vector<VertexId> row;
  for (std::size_t v = 0; v < count; ++v) {
    row.clear();
    for (std::uint32_t a = around_.first[v]; a < around_.first[v + 1]; ++a) {
      const auto& tet = mesh.tets[around_.tets[a]];
      row.insert(row.end(), tet.begin(), tet.end());
    }
    std::sort(row.begin(), row.end());
    column_.insert(column_.end(), row.begin(), std::unique(row.begin(), row.end()));
    first_[v + 1] = static_cast<std::uint32_t>(column_.size());
  }
  blocks_.resize(column_.size());
  inverse_diagonal_.resize(count);
}

void ElasticSystem::assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source) {
#pragma omp parallel for schedule(static, 512)
  for (std::size_t v = 0; v < is_source.size(); ++v) {
    assemble_row(mesh, v, is_source[v] != 0);
  }
}

/// Row v gathers from its tets, so rows are independent. Block of nodes a, b of one tet, with gradients ga,
/// gb: V (lambda ga gb^T + mu gb ga^T + mu (ga . gb) I).
void ElasticSystem::assemble_row(const MaterialMesh& mesh, std::size_t v, bool source) {
  const double young = options_.young_pa * 1e-6;  // N/mm^2, to go with mm
  const double mu = young / (2 * (1 + options_.poisson));
  const double lambda = young * options_.poisson / ((1 + options_.poisson) * (1 - 2 * options_.poisson));
  const std::uint32_t begin = first_[v];
  const std::uint32_t end = first_[v + 1];
  thread_local std::vector<std::array<double, 9>> sums;
  sums.assign(end - begin, {});
  for (std::uint32_t i = around_.first[v]; i < around_.first[v + 1]; ++i) {
    const auto& tet = mesh.tets[around_.tets[i]];
    const TetGradients g = gradients_of(mesh, tet);
    const auto own = static_cast<std::size_t>(std::find(tet.begin(), tet.end(), v) - tet.begin());
    const Vec3& ga = g.gradient[own];
    for (std::size_t n = 0; n < 4; ++n) {
      const Vec3& gb = g.gradient[n];
      const auto place = static_cast<std::size_t>(
          std::lower_bound(column_.begin() + begin, column_.begin() + end, tet[n]) - column_.begin() - begin);
      const double diagonal = mu * ga.dot(gb);
      std::size_t entry = 0;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
          sums[place][entry++] +=
              g.volume * (lambda * ga[r] * gb[c] + mu * gb[r] * ga[c] + (r == c ? diagonal : 0));
        }
      }
    }
  }
  for (std::uint32_t b = begin; b < end; ++b) {
    for (std::size_t e = 0; e < 9; ++e) {
      const bool on_diagonal = source && column_[b] == v && e % 4 == 0;
      blocks_[b][e] = static_cast<float>(sums[b - begin][e] + (on_diagonal ? 1 : 0));
    }
    if (column_[b] == v) {
      inverse_diagonal_[v] = inverse_of(blocks_[b]);
    }
  }
}

void ElasticSystem::multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const {
#pragma omp parallel for schedule(static, 512)
  for (std::size_t v = 0; v < y.size(); ++v) {
    Vec3 sum;
    for (std::uint32_t b = first_[v]; b < first_[v + 1]; ++b) {
      sum += times(blocks_[b], x[column_[b]]);
    }
    y[v] = sum;
  }
}

SolveReport ElasticSystem::solve(const std::vector<Vec3>& load, std::vector<Vec3>& u) const {
  const std::size_t count = load.size();
  std::vector<Vec3> r(count);
  std::vector<Vec3> z(count);
  std::vector<Vec3> q(count);
  multiply(u, q);
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < count; ++v) {
    r[v] = load[v] - q[v];
    z[v] = times(inverse_diagonal_[v], r[v]);
  }
  std::vector<Vec3> p = z;
  const double scale = std::sqrt(dot(load, load));
  double rz = dot(r, z);
  SolveReport report;
  report.relative_residual = scale > 0 ? std::sqrt(dot(r, r)) / scale : 0;
  while (report.iterations < options_.max_iterations && report.relative_residual > options_.tolerance) {
    multiply(p, q);
    const double alpha = rz / dot(p, q);
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < count; ++v) {
      u[v] += alpha * p[v];
      r[v] -= alpha * q[v];
      z[v] = times(inverse_diagonal_[v], r[v]);
    }
    const double next = dot(r, z);
    const double beta = next / rz;
    rz = next;
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < count; ++v) {
      p[v] = z[v] + beta * p[v];
    }
    report.relative_residual = std::sqrt(dot(r, r)) / scale;
    ++report.iterations;
  }
  return report;
}

}  // namespace cbc3d
