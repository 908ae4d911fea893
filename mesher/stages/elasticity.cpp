#include "mesher/stages/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cbc3d {
namespace {

/// The inverse of a diagonal block, the identity for a vertex without stiffness.
std::array<double, 9> inverse_of(const std::array<float, 9>& m) {
  const Vec3 r0{m[0], m[1], m[2]};
  const Vec3 r1{m[3], m[4], m[5]};
  const Vec3 r2{m[6], m[7], m[8]};
  const Vec3 c0 = r1.cross(r2);
  const Vec3 c1 = r2.cross(r0);
  const Vec3 c2 = r0.cross(r1);
  const double det = r0.dot(c0);
  if (!(det > 0)) {
    return {1, 0, 0, 0, 1, 0, 0, 0, 1};
  }
  const double s = 1 / det;
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

ElasticSystem::ElasticSystem(const MaterialMesh& mesh, const VertexCells& around,
                             const std::vector<ElasticMaterial>& materials, const ElasticityOptions& options)
    : options_(options), around_(around) {
  std::transform(materials.begin(), materials.end(), std::back_inserter(lame_), lame_constants);
  const std::size_t count = mesh.points.size();
  const auto row_of = [&](std::size_t v, std::vector<VertexId>& row) {
    row.clear();
    for (const CellId c : around.of(static_cast<VertexId>(v))) {
      const auto nodes = mesh.nodes_of(c);
      row.insert(row.end(), nodes.begin(), nodes.end());
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  };
  first_.assign(count + 1, 0);
#pragma omp parallel
  {
    std::vector<VertexId> row;
#pragma omp for schedule(static, 512)
    for (std::size_t v = 0; v < count; ++v) {
      row_of(v, row);
      first_[v + 1] = row.size();
    }
  }
  for (std::size_t v = 0; v < count; ++v) {
    first_[v + 1] += first_[v];
  }
  column_.resize(first_[count]);
#pragma omp parallel
  {
    std::vector<VertexId> row;
#pragma omp for schedule(static, 512)
    for (std::size_t v = 0; v < count; ++v) {
      row_of(v, row);
      std::copy(row.begin(), row.end(), column_.begin() + static_cast<std::ptrdiff_t>(first_[v]));
    }
  }
  blocks_.resize(column_.size());
  inverse_diagonal_.resize(count);
}

void ElasticSystem::assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source) {
#pragma omp parallel
  {
    Scratch scratch;
    scratch.place.resize(is_source.size());
#pragma omp for schedule(static, 512)
    for (std::size_t v = 0; v < is_source.size(); ++v) {
      assemble_upper_row(mesh, static_cast<VertexId>(v), is_source[v] != 0, scratch);
    }
#pragma omp for schedule(static, 512)
    for (std::size_t v = 0; v < is_source.size(); ++v) {
      mirror_lower_row(static_cast<VertexId>(v));
    }
  }
}

/// Row v from its diagonal on; it gathers from the cells at v, so rows are independent.
void ElasticSystem::assemble_upper_row(const MaterialMesh& mesh, VertexId v, bool source, Scratch& scratch) {
  const auto columns = neighbours(v);
  const auto diagonal =
      static_cast<std::size_t>(std::lower_bound(columns.begin(), columns.end(), v) - columns.begin());
  scratch.sums.assign(columns.size() - diagonal, {});
  for (std::size_t b = diagonal; b < columns.size(); ++b) {
    scratch.place[columns[b]] = static_cast<std::uint32_t>(b - diagonal);
  }
  for (const CellId c : around_.of(v)) {
    const auto nodes = mesh.nodes_of(c);
    std::size_t own = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      scratch.points[n] = mesh.points[nodes[n]];
      scratch.row[n] = nodes[n] < v ? nullptr : &scratch.sums[scratch.place[nodes[n]]];
      own = nodes[n] == v ? n : own;
    }
    add_element_stiffness_row({scratch.points.data(), nodes.size()}, own, lame_[mesh.material_of(c)],
                              {scratch.row.data(), nodes.size()});
  }
  for (std::size_t e = 0; e < 9 && source && !scratch.sums.empty(); e += 4) {
    scratch.sums[0][e] += 1;
  }
  for (std::size_t b = diagonal; b < columns.size(); ++b) {
    std::copy(scratch.sums[b - diagonal].begin(), scratch.sums[b - diagonal].end(),
              blocks_[first_[v] + b].begin());
  }
  if (diagonal < columns.size()) {
    inverse_diagonal_[v] = inverse_of(blocks_[first_[v] + diagonal]);
  }
}

/// Row v before its diagonal: the transposed blocks of the rows above.
void ElasticSystem::mirror_lower_row(VertexId v) {
  const auto columns = neighbours(v);
  for (std::size_t b = 0; b < columns.size() && columns[b] < v; ++b) {
    const auto above = neighbours(columns[b]);
    const auto place =
        static_cast<std::size_t>(std::lower_bound(above.begin(), above.end(), v) - above.begin());
    const Block& m = blocks_[first_[columns[b]] + place];
    blocks_[first_[v] + b] = {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
  }
}

void ElasticSystem::multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const {
#pragma omp parallel for schedule(static, 512)
  for (std::size_t v = 0; v < y.size(); ++v) {
    Vec3 sum;
    for (std::uint64_t b = first_[v]; b < first_[v + 1]; ++b) {
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
