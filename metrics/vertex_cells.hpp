// The cells at every vertex of a mesh.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

struct VertexCells {
  std::vector<std::uint64_t> first;  ///< where the cells of each vertex begin, and the end
  std::vector<std::uint32_t> cells;  ///< of each vertex ascending

  explicit VertexCells(const MeshView& view) : first(view.mesh().points.size() + 1, 0) {
    for (std::size_t c = 0; c < view.cell_count(); ++c) {
      for (const VertexId v : view.cell(c).nodes) {
        ++first[v + 1];
      }
    }
    for (std::size_t v = 1; v < first.size(); ++v) {
      first[v] += first[v - 1];
    }
    cells.resize(first.back());
    std::vector<std::uint64_t> next(first.begin(), first.end() - 1);
    for (std::size_t c = 0; c < view.cell_count(); ++c) {
      for (const VertexId v : view.cell(c).nodes) {
        cells[next[v]++] = static_cast<std::uint32_t>(c);
      }
    }
  }
  [[nodiscard]] std::span<const std::uint32_t> at(VertexId v) const {
    return {cells.data() + first[v], cells.data() + first[v + 1]};
  }
};

}  // namespace cbc3d::metrics
