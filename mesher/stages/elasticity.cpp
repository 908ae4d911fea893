#include "mesher/stages/elasticity.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cbc3d {
namespace {

/// columns += s a b^T.
void add_product(float s, const Float4& a, const Float4& b, Columns3& m) {
  const Float4 sa = s * a;
  m.c[0] += sa * spread<0>(b);
  m.c[1] += sa * spread<1>(b);
  m.c[2] += sa * spread<2>(b);
}

/// ratio Q + Q^T + tr(Q) I + rest.
Columns3 stiffness_of(float ratio, const Columns3& q, const Columns3& rest) {
  const float trace = q.c[0][0] + q.c[1][1] + q.c[2][2];
  Columns3 k;
  transpose(q.c, k.c);
  for (int i = 0; i < 3; ++i) {
    k.c[i] += ratio * q.c[i] + rest.c[i];
  }
  k.c[0] += Float4(trace, 0, 0, 0);
  k.c[1] += Float4(0, trace, 0, 0);
  k.c[2] += Float4(0, 0, trace, 0);
  return k;
}

}  // namespace

ElasticSystem::ElasticSystem(const MaterialMesh& mesh, const VertexCells& around,
                             const std::vector<ElasticMaterial>& materials, const ElasticityOptions& options)
    : options_(options), around_(around), shape_(mesh.tets.size()), matrix_(mesh, around) {
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
    for (std::size_t t = 0; t < shape_.size(); ++t) {
      const auto& n = mesh.tets[t];
      shape_[t] = tet_gradients(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]],
                                lame_[mesh.materials[t]].mu);
    }
    Scratch scratch;
    scratch.place.resize(is_source.size());
#pragma omp for schedule(static, 512)
    for (std::size_t v = 0; v < is_source.size(); ++v) {
      assemble_row(mesh, static_cast<VertexId>(v), is_source[v] != 0, scratch);
    }
  }
}

/// It gathers from the cells at v, so rows are independent. The diagonal block is what the others lack to a
/// sum of zero, for a mesh that is moved as a whole has no force in it.
void ElasticSystem::assemble_row(const MaterialMesh& mesh, VertexId v, bool source, Scratch& scratch) {
  const auto columns = matrix_.columns(v);
  scratch.sums.assign(columns.size(), {});
  for (std::size_t b = 0; b < columns.size(); ++b) {
    scratch.place[columns[b]] = static_cast<std::uint32_t>(b);
  }
  for (const CellId c : around_.of(v)) {
    if (c < shape_.size()) {
      add_tet(mesh, c, v, scratch);
    } else {
      add_other_cell(mesh, c, v, scratch);
    }
  }
  Columns3 diagonal;
  for (std::size_t b = 0; b < columns.size(); ++b) {
    if (columns[b] != v) {
      const Columns3 block = stiffness_of(ratio_, scratch.sums[b].q, scratch.sums[b].rest);
      matrix_.set_block(v, b, block);
      for (int i = 0; i < 3; ++i) {
        diagonal.c[i] -= block.c[i];
      }
    }
  }
  if (source) {
    diagonal.c[0] += Float4(1, 0, 0, 0);
    diagonal.c[1] += Float4(0, 1, 0, 0);
    diagonal.c[2] += Float4(0, 0, 1, 0);
  }
  matrix_.set_block(v, scratch.place[v], diagonal);
  matrix_.set_inverse_diagonal(v, inverse_of(diagonal));
}

void ElasticSystem::add_tet(const MaterialMesh& mesh, CellId tet, VertexId v, Scratch& scratch) const {
  const auto& nodes = mesh.tets[tet];
  const auto& [g1, g2, g3] = shape_[tet];
  const std::array<Float4, 4> g = {Float4() - (g1 + g2 + g3), g1, g2, g3};
  const auto own = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), v) - nodes.begin());
  for (std::size_t n = 1; n < 4; ++n) {
    const std::size_t other = (own + n) & 3U;
    BlockSum& sum = scratch.sums[scratch.place[nodes[other]]];
    add_product(1, g[own], g[other], sum.q);
    if (!one_ratio_) {
      const LameConstants& lame = lame_[mesh.materials[tet]];
      add_product(static_cast<float>(lame.lambda / lame.mu), g[own], g[other], sum.rest);
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
    Columns3& rest = scratch.sums[scratch.place[nodes[n]]].rest;
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
