#include "mesher/deform/quality_control.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/core/parallel.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

constexpr int kHalvings = 4;

}  // namespace

QualityControl::QualityControl(const MaterialMesh& mesh, const VertexCells& around,
                               const QualityOptions& options)
    : mesh_(mesh),
      around_(around),
      max_cosine_(std::cos(options.min_dihedral_deg * std::numbers::pi / 180)),
      min_scaled_jacobian_(options.min_scaled_jacobian) {}

/// How far a cell is above the minimum quality; negative below it.
double QualityControl::margin(CellId cell, const std::vector<Vec3>& points) const {
  const auto nodes = mesh_.nodes_of(cell);
  std::array<Vec3, 8> p;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    p[n] = points[nodes[n]];
  }
  if (nodes.size() == 4) {
    return max_cosine_ - max_dihedral_cosine(p[0], p[1], p[2], p[3]);
  }
  const double jacobian = nodes.size() == 5 ? scaled_jacobian_pyramid(std::span<const Vec3, 5>(p.data(), 5))
                                            : scaled_jacobian_hex(std::span<const Vec3, 8>(p));
  return jacobian - min_scaled_jacobian_;
}

bool QualityControl::fails(CellId cell, const std::vector<Vec3>& before,
                           const std::vector<Vec3>& after) const {
  if (cell < mesh_.tets.size()) {
    const auto& n = mesh_.tets[cell];
    if (surely_no_cosine_above(after[n[0]], after[n[1]], after[n[2]], after[n[3]], max_cosine_)) {
      return false;
    }
  }
  const double now = margin(cell, after);
  return now < 0 && now < margin(cell, before);
}

std::vector<CellId> QualityControl::failing(const std::vector<Vec3>& before,
                                            const std::vector<Vec3>& after) const {
  return indices_where(mesh_.cell_count(),
                       [&](std::size_t c) { return fails(static_cast<CellId>(c), before, after); });
}

/// Of cells that lie anywhere in memory: what the next ones need is asked for ahead.
std::vector<CellId> QualityControl::those_that_fail(std::span<const CellId> cells,
                                                    const std::vector<Vec3>& before,
                                                    const std::vector<Vec3>& after) const {
  constexpr std::size_t kNodesAhead = 16, kPointsAhead = 8;
  const auto tet_ahead = [&](std::size_t i) {
    return i < cells.size() && cells[i] < mesh_.tets.size() ? &mesh_.tets[cells[i]] : nullptr;
  };
  std::vector<CellId> failed;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (const auto* later = tet_ahead(i + kNodesAhead)) {
      __builtin_prefetch(later);
    }
    if (const auto* next = tet_ahead(i + kPointsAhead)) {
      for (const VertexId v : *next) {
        __builtin_prefetch(&after[v]);
      }
    }
    if (fails(cells[i], before, after)) {
      failed.push_back(cells[i]);
    }
  }
  return failed;
}

std::vector<CellId> QualityControl::failing_around(const std::vector<VertexId>& vertices,
                                                   const std::vector<Vec3>& before,
                                                   const std::vector<Vec3>& after,
                                                   std::vector<std::uint32_t>& seen,
                                                   std::uint32_t round) const {
  constexpr std::size_t kChunk = 128;
  std::vector<std::vector<CellId>> chunks((vertices.size() + kChunk - 1) / kChunk);
#pragma omp parallel if (chunks.size() > 1)
  {
    std::vector<CellId> cells;
#pragma omp for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      cells.clear();
      for (std::size_t n = c * kChunk; n < std::min(vertices.size(), (c + 1) * kChunk); ++n) {
        for (const CellId cell : around_.of(vertices[n])) {
          if (is_first(seen[cell], round)) {
            cells.push_back(cell);
          }
        }
      }
      chunks[c] = those_that_fail(cells, before, after);
    }
  }
  std::vector<CellId> all;
  for (const auto& chunk : chunks) {
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  return all;
}

std::size_t QualityControl::hold_back(const std::vector<Vec3>& before, std::vector<CellId> failing,
                                      std::vector<Vec3>& displacement, std::vector<Vec3>& after) const {
  std::vector<std::uint8_t> halvings(before.size(), 0);
  std::vector<std::uint32_t> vertex_seen(before.size(), 0), cell_seen(mesh_.cell_count(), 0);
  std::size_t held = 0;
  for (std::uint32_t round = 1; !failing.empty(); ++round) {
    const std::vector<VertexId> vertices =
        collect<VertexId>(failing.size(), 8, [&](std::size_t i, const auto& add) {
          for (const VertexId v : mesh_.nodes_of(failing[i])) {
            if (is_first(vertex_seen[v], round)) {
              add(v);
            }
          }
        });
#pragma omp parallel for schedule(static) reduction(+ : held) if (vertices.size() > 4096)
    for (const VertexId v : vertices) {
      held += halvings[v] == 0 ? 1 : 0;
      halvings[v] = static_cast<std::uint8_t>(std::min(halvings[v] + 1, kHalvings + 1));
      displacement[v] = halvings[v] <= kHalvings ? displacement[v] * 0.5 : Vec3{};  // NaN times 0 is NaN
      after[v] = before[v] + displacement[v];
    }
    failing = failing_around(vertices, before, after, cell_seen, round);
  }
  return held;
}

}  // namespace cbc3d
