#include "mesher/deform/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cbc3d {
namespace {

/// m += a b^T.
void add_product(const Float4& a, const Float4& b, Columns3& m) {
  m.c[0] += a * spread<0>(b);
  m.c[1] += a * spread<1>(b);
  m.c[2] += a * spread<2>(b);
}

void add(const Columns3& what, Columns3& to) {
  for (int i = 0; i < 3; ++i) {
    to.c[i] += what.c[i];
  }
}

/// ratio Q + Q^T + tr(Q) I.
Columns3 stiffness_of(float ratio, const Columns3& q) {
  const float trace = q.c[0][0] + q.c[1][1] + q.c[2][2];
  Columns3 k;
  transpose(q.c, k.c);
  for (int i = 0; i < 3; ++i) {
    k.c[i] += ratio * q.c[i];
  }
  k.c[0] += Float4(trace, 0, 0, 0);
  k.c[1] += Float4(0, trace, 0, 0);
  k.c[2] += Float4(0, 0, trace, 0);
  return k;
}

}  // namespace

ElasticSystem::ElasticSystem(const MaterialMesh& mesh, const VertexCells& around,
                             const std::vector<ElasticMaterial>& materials, const ElasticityOptions& options)
    : options_(options),
      around_(around),
      tet_count_(mesh.tets.size()),
      shape_(std::make_unique_for_overwrite<TetGradients[]>(tet_count_)),
      matrix_(mesh, around) {
  std::transform(materials.begin(), materials.end(), std::back_inserter(lame_), lame_constants);
  const double poisson = materials.empty() ? 0 : materials[0].poisson;
  one_ratio_ = mesh.tets.size() == mesh.cell_count() &&
               std::all_of(materials.begin(), materials.end(),
                           [&](const ElasticMaterial& m) { return m.poisson == poisson; });
  ratio_ = one_ratio_ ? static_cast<float>(2 * poisson / (1 - 2 * poisson)) : 0;
}

void ElasticSystem::assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source) {
#pragma omp parallel
  {
#pragma omp for schedule(static)
    for (std::size_t t = 0; t < tet_count_; ++t) {
      const auto& n = mesh.tets[t];
      shape_[t] = tet_gradients(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]],
                                lame_[mesh.materials[t]].mu);
    }
    Scratch scratch;
    scratch.place.resize(is_source.size());
#pragma omp for schedule(static, 64)
    for (std::size_t v = 0; v < is_source.size(); ++v) {
      assemble_row(mesh, static_cast<VertexId>(v), is_source[v] != 0, scratch);
    }
  }
}

/// It gathers from the cells at v, so rows are independent. The diagonal block is what the others lack to a
/// sum of zero, for a mesh that is moved as a whole has no force in it.
void ElasticSystem::assemble_row(const MaterialMesh& mesh, VertexId v, bool source, Scratch& scratch) {
  const auto columns = matrix_.columns(v);
  scratch.q.assign(columns.size(), {});
  scratch.rest.assign(one_ratio_ ? 0 : columns.size(), {});
  for (std::size_t b = 0; b < columns.size(); ++b) {
    scratch.place[columns[b]] = static_cast<std::uint32_t>(b);
  }
  for (const CellId c : around_.of(v)) {
    if (c < tet_count_) {
      add_tet(mesh, c, v, scratch);
    } else {
      add_other_cell(mesh, c, v, scratch);
    }
  }
  Columns3 diagonal{};
  for (std::size_t b = 1; b < columns.size(); ++b) {
    Columns3 block = stiffness_of(ratio_, scratch.q[b]);
    if (!one_ratio_) {
      add(scratch.rest[b], block);
    }
    matrix_.set_block(v, b, block);
    for (int i = 0; i < 3; ++i) {
      diagonal.c[i] -= block.c[i];
    }
  }
  if (source) {
    diagonal.c[0] += Float4(1, 0, 0, 0);
    diagonal.c[1] += Float4(0, 1, 0, 0);
    diagonal.c[2] += Float4(0, 0, 1, 0);
  }
  matrix_.set_block(v, 0, diagonal);
  matrix_.set_inverse_diagonal(v, inverse_of(diagonal));
}

void ElasticSystem::add_tet(const MaterialMesh& mesh, CellId tet, VertexId v, Scratch& scratch) const {
  const auto& nodes = mesh.tets[tet];
  const auto& [g1, g2, g3] = shape_[tet];
  const std::array<Float4, 4> g = {Float4() - (g1 + g2 + g3), g1, g2, g3};
  const std::size_t own = nodes[0] == v ? 0 : nodes[1] == v ? 1 : nodes[2] == v ? 2 : 3;
  for (std::size_t n = 1; n < 4; ++n) {
    const std::size_t other = (own + n) & 3U;
    add_product(g[own], g[other], scratch.q[scratch.place[nodes[other]]]);
  }
  if (!one_ratio_) {
    const LameConstants& lame = lame_[mesh.materials[tet]];
    const Float4 scaled = static_cast<float>(lame.lambda / lame.mu) * g[own];
    for (std::size_t n = 1; n < 4; ++n) {
      const std::size_t other = (own + n) & 3U;
      add_product(scaled, g[other], scratch.rest[scratch.place[nodes[other]]]);
    }
  }
}

void ElasticSystem::add_other_cell(const MaterialMesh& mesh, CellId cell, VertexId v,
                                   Scratch& scratch) const {
  const auto nodes = mesh.nodes_of(cell);
  std::array<StiffnessBlock*, 8> row{};
  std::size_t own = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    scratch.points[n] = mesh.points[nodes[n]];
    scratch.row[n] = {};
    row[n] = &scratch.row[n];
    own = nodes[n] == v ? n : own;
  }
  add_element_stiffness_row({scratch.points.data(), nodes.size()}, own, lame_[mesh.material_of(cell)],
                            {row.data(), nodes.size()});
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const StiffnessBlock& k = scratch.row[n];
    Columns3& rest = scratch.rest[scratch.place[nodes[n]]];
    rest.c[0] += Float4(Vec3{k[0], k[3], k[6]});
    rest.c[1] += Float4(Vec3{k[1], k[4], k[7]});
    rest.c[2] += Float4(Vec3{k[2], k[5], k[8]});
  }
}

void ElasticSystem::multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const {
  const std::vector<Float4> from(x.begin(), x.end());
#pragma omp parallel for schedule(static, 512)
  for (std::size_t v = 0; v < y.size(); ++v) {
    y[v] = matrix_.row_times(static_cast<VertexId>(v), from).xyz();
  }
}

}  // namespace cbc3d
