#include "mesher/stages/quality_control.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "mesher/stages/cell_quality.hpp"

namespace cbc3d {
namespace {

constexpr int kHalvings = 4;

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

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
    if (has_no_cosine_above(after[n[0]], after[n[1]], after[n[2]], after[n[3]], max_cosine_)) {
      return false;
    }
  }
  const double now = margin(cell, after);
  return now < 0 && now < margin(cell, before);
}

std::vector<CellId> QualityControl::failing(const std::vector<Vec3>& before,
                                            const std::vector<Vec3>& after) const {
  constexpr std::size_t kChunk = 8192;
  const std::size_t count = mesh_.cell_count();
  std::vector<std::vector<CellId>> chunks((count + kChunk - 1) / kChunk);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    for (std::size_t cell = c * kChunk; cell < std::min(count, (c + 1) * kChunk); ++cell) {
      if (fails(static_cast<CellId>(cell), before, after)) {
        chunks[c].push_back(static_cast<CellId>(cell));
      }
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
  std::unordered_map<VertexId, int> halvings;
  std::vector<VertexId> vertices;
  std::vector<CellId> cells;
  while (!failing.empty()) {
    vertices.clear();
    for (const CellId c : failing) {
      const auto nodes = mesh_.nodes_of(c);
      vertices.insert(vertices.end(), nodes.begin(), nodes.end());
    }
    sort_unique(vertices);
    cells.clear();
    for (const VertexId v : vertices) {
      displacement[v] *= ++halvings[v] <= kHalvings ? 0.5 : 0.0;
      after[v] = before[v] + displacement[v];
      cells.insert(cells.end(), around_.of(v).begin(), around_.of(v).end());
    }
    sort_unique(cells);
    failing.clear();
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(failing),
                 [&](CellId c) { return fails(c, before, after); });
  }
  return halvings.size();
}

}  // namespace cbc3d
