#include "metrics/gradation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "mesher/core/parallel.hpp"
#include "metrics/element_shape.hpp"
#include "metrics/order_statistics.hpp"
#include "metrics/reduce.hpp"
#include "metrics/vertex_cells.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<double> volumes_mm3(const MeshView& view) {
  const std::vector<Vec3>& points = view.mesh().points;
  std::vector<double> volumes(view.cell_count());
#pragma omp parallel for if (volumes.size() > kWorthThreads)
  for (std::size_t c = 0; c < volumes.size(); ++c) {
    const TetSplit split = split_into_tets(view.cell(c));
    double volume = 0;
    for (int t = 0; t < split.count; ++t) {
      const auto& tet = split.tets[static_cast<std::size_t>(t)];
      volume += six_volumes(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]) / 6;
    }
    volumes[c] = std::fabs(volume);
  }
  return volumes;
}

void find_size_ratios(const MeshView& view, const std::vector<Facet>& facets, Gradation& result) {
  const std::vector<double> volumes = volumes_mm3(view);
  const auto is_alike = [&facets](std::size_t a, std::size_t b) {
    return b < facets.size() && facets[a].cycle == facets[b].cycle;
  };
  std::vector<float> ratios = collect<float>(facets.size(), 1, [&](std::size_t f, const auto& add) {
    const bool begins_pair = is_alike(f, f + 1) && !is_alike(f, f + 2) && (f == 0 || !is_alike(f - 1, f));
    if (begins_pair) {
      const auto [less, more] = std::minmax(volumes[facets[f].cell], volumes[facets[f + 1].cell]);
      add(static_cast<float>(less > 0 ? std::cbrt(more / less) : kInfinity));
    }
  });
  if (const auto found = order_statistics(std::span(ratios), std::array<std::size_t, 2>{990, 1000})) {
    result.size_ratio_p99 = (*found)[0];
    result.size_ratio_max = (*found)[1];
  }
}

struct VertexFigures {
  std::vector<std::uint32_t> valence;  // 0 of a vertex of no cell
  std::vector<float> edge_ratio;
};

void add_neighbours(const CellView& cell, VertexId v, std::vector<VertexId>& neighbours) {
  for (const auto& [a, b] : edges_of(cell.kind)) {
    const VertexId one = cell.nodes[a], other = cell.nodes[b];
    if (one == v || other == v) {
      neighbours.push_back(one == v ? other : one);
    }
  }
}

VertexFigures vertex_figures(const MeshView& view, const VertexCells& at) {
  const std::vector<Vec3>& points = view.mesh().points;
  VertexFigures figures{std::vector<std::uint32_t>(points.size()), std::vector<float>(points.size())};
#pragma omp parallel if (points.size() > kWorthThreads)
  {
    std::vector<VertexId> neighbours;
#pragma omp for schedule(dynamic, 4096)
    for (std::size_t v = 0; v < points.size(); ++v) {
      neighbours.clear();
      for (const std::uint32_t c : at.at(static_cast<VertexId>(v))) {
        add_neighbours(view.cell(c), static_cast<VertexId>(v), neighbours);
      }
      std::sort(neighbours.begin(), neighbours.end());
      neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
      double longest = 0, shortest = kInfinity;
      for (const VertexId end : neighbours) {
        const double squared = (points[end] - points[v]).squared_norm();
        longest = std::max(longest, squared);
        shortest = std::min(shortest, squared);
      }
      figures.valence[v] = static_cast<std::uint32_t>(neighbours.size());
      figures.edge_ratio[v] = static_cast<float>(shortest > 0 ? std::sqrt(longest / shortest) : kInfinity);
    }
  }
  return figures;
}

void find_valences(const MeshView& view, Gradation& result) {
  const VertexFigures figures = vertex_figures(view, VertexCells(view));
  const auto is_used = [&figures](std::size_t v) { return figures.valence[v] > 0; };
  std::vector<std::uint32_t> valences = figures.valence;
  std::erase(valences, 0U);
  result.all.vertices = static_cast<std::int64_t>(valences.size());
  const auto found = order_statistics(std::span(valences), std::array<std::size_t, 3>{500, 990, 1000});
  if (!found) {
    return;
  }
  result.valence_median = static_cast<std::int64_t>((*found)[0]);
  result.valence_p99 = static_cast<std::int64_t>((*found)[1]);
  result.valence_max = static_cast<std::int64_t>((*found)[2]);
  result.valence_max_vertex = static_cast<std::size_t>(
      std::max_element(figures.valence.begin(), figures.valence.end()) - figures.valence.begin());
  std::vector<float> ratios;
  ratios.reserve(valences.size());
  for (std::size_t v = 0; v < figures.valence.size(); ++v) {
    if (is_used(v)) {
      ratios.push_back(figures.edge_ratio[v]);
    }
  }
  const auto ratio = order_statistics(std::span(ratios), std::array<std::size_t, 2>{990, 1000}).value();
  result.vertex_edge_ratio_p99 = ratio[0];
  result.vertex_edge_ratio_max = ratio[1];
}

std::int64_t count_on_surface(const Surface& surface, std::size_t points, bool outer_alone) {
  std::vector<std::uint8_t> on(points, 0);
  std::int64_t count = 0;
  for (const SurfaceFacet& facet : surface.facets) {
    if (outer_alone && facet.outside != kOutside) {
      continue;
    }
    for (std::size_t n = 0; n < facet.corners(); ++n) {
      count += on[facet.nodes[n]] == 0 ? 1 : 0;
      on[facet.nodes[n]] = 1;
    }
  }
  return count;
}

// Vertices of each label: a vertex counts at the first cell of the label among those met.
std::vector<std::int64_t> vertices_per_label(const MeshView& view) {
  const std::size_t labels = view.labels().size(), cells = view.cell_count();
  std::vector<std::size_t> end(labels + 1, 0);
  for (std::size_t c = 0; c < cells; ++c) {
    ++end[view.label_index(c) + 1];
  }
  for (std::size_t l = 0; l < labels; ++l) {
    end[l + 1] += end[l];
  }
  std::vector<std::uint32_t> by_label(cells);
  std::vector<std::size_t> next(end.begin(), end.end() - 1);
  for (std::size_t c = 0; c < cells; ++c) {
    by_label[next[view.label_index(c)]++] = static_cast<std::uint32_t>(c);
  }
  std::vector<std::uint32_t> last_label(view.mesh().points.size(), kOutside);
  std::vector<std::int64_t> vertices(labels, 0);
  for (const std::uint32_t c : by_label) {
    const std::uint32_t label = view.label_index(c);
    for (const VertexId v : view.cell(c).nodes) {
      vertices[label] += last_label[v] != label ? 1 : 0;
      last_label[v] = label;
    }
  }
  return vertices;
}

void find_inner_vertices(const MeshView& view, const Surface& surface, Gradation& result) {
  const std::size_t points = view.mesh().points.size();
  result.all.inner = result.all.vertices - count_on_surface(surface, points, true);
  result.off_all_surfaces = result.all.vertices - count_on_surface(surface, points, false);
  const std::vector<std::int64_t> vertices = vertices_per_label(view);
  for (std::size_t l = 0; l < vertices.size(); ++l) {
    const auto on_surface = static_cast<std::int64_t>(surface.vertices_of[l].size());
    result.per_label.push_back({vertices[l], vertices[l] - on_surface});
  }
}

nlohmann::json count_or_null(const std::optional<std::int64_t>& count) {
  return count ? nlohmann::json(*count) : nlohmann::json(nullptr);
}

}  // namespace

Gradation gradation(const MeshView& view, const std::vector<Facet>& facets, const Surface& surface) {
  Gradation result;
  find_size_ratios(view, facets, result);
  find_valences(view, result);
  find_inner_vertices(view, surface, result);
  return result;
}

void write_json(nlohmann::json& quality, const Gradation& gradation, const MeshView& view) {
  quality["neighbour_size_ratio"] = {{"p99", number_or_null(gradation.size_ratio_p99)},
                                     {"max", number_or_null(gradation.size_ratio_max)}};
  quality["valence_median"] = count_or_null(gradation.valence_median);
  quality["valence_p99"] = count_or_null(gradation.valence_p99);
  quality["valence_max"] = count_or_null(gradation.valence_max);
  quality["valence_max_at_mm"] = nullptr;
  if (gradation.valence_max) {
    const Vec3& at = view.mesh().points[gradation.valence_max_vertex];
    quality["valence_max_at_mm"] = {at.x, at.y, at.z};
  }
  quality["vertex_edge_ratio"] = {{"p99", number_or_null(gradation.vertex_edge_ratio_p99)},
                                  {"max", number_or_null(gradation.vertex_edge_ratio_max)}};
  quality["inner_vertices"] = gradation.all.inner;
  quality["inner_vertices_percent"] = number_or_null(gradation.all.percent());
  const InnerVertices off_all{gradation.all.vertices, gradation.off_all_surfaces};
  quality["vertices_off_surfaces_percent"] = number_or_null(off_all.percent());
  for (std::size_t l = 0; l < gradation.per_label.size(); ++l) {
    quality["per_label"][l]["inner_vertices_percent"] = number_or_null(gradation.per_label[l].percent());
  }
}

}  // namespace cbc3d::metrics
