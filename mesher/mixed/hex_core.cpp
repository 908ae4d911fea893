#include "mesher/mixed/hex_core.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>

#include "mesher/topology/material_set.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Layers of tets between the core and the surfaces, of the size that tets have at the surfaces. With two the
/// surfaces of fine meshes get rougher, for their tets cannot be graded; three cost a fifth of the hexes.
constexpr double kBandLayers = 2.5;

/// Hexes of spacing a have 1 / a^3 vertices in a unit of volume. The decimation leaves edges of about .78
/// times the length L that it allows, and tets with edges of length e have 1.5 / e^3 vertices, so hexes have
/// fewer from a = .68 L on.
constexpr double kSpacingShare = 0.68;

/// The depth of every vertex, at most `limit_mm`. The nearest interface vertex is handed on from vertex to
/// vertex along the edges (vector distance transform), so that depths are straight distances.
std::vector<double> depths_mm(const MaterialMesh& mesh, double limit_mm) {
  struct Front {
    double depth;
    VertexId vertex, source;
    bool operator>(const Front& other) const {
      return std::tie(depth, vertex, source) > std::tie(other.depth, other.vertex, other.source);
    }
  };
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  const VertexCells around = tets_of_vertices(mesh.tets, mesh.points.size());
  std::vector<double> depth(mesh.points.size(), limit_mm);
  std::priority_queue<Front, std::vector<Front>, std::greater<>> open;  // the nearest first
  for (VertexId v = 0; v < sets.size(); ++v) {
    if (sets[v].size > 1) {
      depth[v] = 0;
      open.push({0, v, v});
    }
  }
  while (!open.empty()) {
    const Front front = open.top();
    open.pop();
    if (front.depth > depth[front.vertex]) {
      continue;  // a nearer source has been found since
    }
    for (const TetId t : around.of(front.vertex)) {
      for (const VertexId w : mesh.tets[t]) {
        const double there = (mesh.points[w] - mesh.points[front.source]).norm();
        if (there < depth[w]) {
          depth[w] = there;
          open.push({there, w, front.source});
        }
      }
    }
  }
  return depth;
}

/// Of the tets around each vertex.
struct StarExtents {
  std::vector<double> spacing_mm;     ///< the longest edge
  std::vector<double> shallowest_mm;  ///< the smallest depth of a vertex
  std::vector<MaterialId> some_material;
};

StarExtents extents_of_stars(const MaterialMesh& mesh, const std::vector<double>& depth_mm) {
  const std::size_t vertices = mesh.points.size();
  StarExtents stars{std::vector<double>(vertices, 0), std::vector<double>(vertices, kInfinity),
                    std::vector<MaterialId>(vertices, kBackground)};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets[t];
    double longest = 0;
    double shallowest = kInfinity;
    for (std::size_t i = 0; i < 4; ++i) {
      shallowest = std::min(shallowest, depth_mm[tet[i]]);
      for (std::size_t j = i + 1; j < 4; ++j) {
        longest = std::max(longest, (mesh.points[tet[i]] - mesh.points[tet[j]]).squared_norm());
      }
    }
    longest = std::sqrt(longest);
    for (const VertexId v : tet) {
      stars.spacing_mm[v] = std::max(stars.spacing_mm[v], longest);
      stars.shallowest_mm[v] = std::min(stars.shallowest_mm[v], shallowest);
      stars.some_material[v] = mesh.materials[t];
    }
  }
  return stars;
}

/// The depth from which on nothing depends on it any more.
double greatest_depth_mm(const HexCoreOptions& options) {
  const double to_longest = options.gradation > 0 && std::isfinite(options.longest_mm)
                                ? (options.longest_mm - options.surface_edge_mm) / options.gradation
                            : options.gradation > 0 ? kInfinity
                                                    : 0;
  return std::max(2 * kBandLayers * options.surface_edge_mm, to_longest);
}

/// How long edges may grow at a depth.
double allowed_length_mm(const HexCoreOptions& options, double depth_mm, MaterialId material) {
  double longest = options.longest_mm;
  if (!options.longest_of_material_mm.empty()) {
    longest = std::min(longest, options.longest_of_material_mm[material]);
  }
  return options.gradation < 0 ? longest
                               : std::min(longest, options.surface_edge_mm + options.gradation * depth_mm);
}

std::vector<std::uint8_t> allowed_centres(const MaterialMesh& mesh, const HexCoreOptions& options) {
  const std::vector<double> depth_mm = depths_mm(mesh, greatest_depth_mm(options));
  const StarExtents stars = extents_of_stars(mesh, depth_mm);
  std::vector<std::uint8_t> allowed(mesh.points.size(), 0);
  for (std::size_t v = 0; v < allowed.size(); ++v) {
    const double length_mm = allowed_length_mm(options, depth_mm[v], stars.some_material[v]);
    allowed[v] = stars.shallowest_mm[v] >= kBandLayers * options.surface_edge_mm &&
                         stars.spacing_mm[v] >= kSpacingShare * length_mm
                     ? 1
                     : 0;
  }
  return allowed;
}

auto as_tuple(const Vec3& p) {
  return std::tuple(p.x, p.y, p.z);
}

/// The vertices at some places; places without one are left out.
std::vector<VertexId> vertices_at(const std::vector<Vec3>& points, std::span<const Vec3> places) {
  std::vector<VertexId> order(points.size());
  for (VertexId v = 0; v < order.size(); ++v) {
    order[v] = v;
  }
  std::sort(order.begin(), order.end(), [&](VertexId a, VertexId b) {
    return std::tuple(as_tuple(points[a]), a) < std::tuple(as_tuple(points[b]), b);
  });
  std::vector<VertexId> found;
  for (const Vec3& place : places) {
    const auto at = std::lower_bound(order.begin(), order.end(), place, [&](VertexId v, const Vec3& p) {
      return as_tuple(points[v]) < as_tuple(p);
    });
    if (at != order.end() && points[*at] == place) {
      found.push_back(*at);
    }
  }
  return found;
}

}  // namespace

HexCore choose_hex_core(const MaterialMesh& mesh, const HexCoreOptions& options, const MixOptions& mix) {
  const std::vector<VertexId> centres = choose_centres(mesh, mix, allowed_centres(mesh, options));
  HexCore core;
  core.fixed.assign(mesh.points.size(), 0);
  const VertexCells around = tets_of_vertices(mesh.tets, mesh.points.size());
  for (const VertexId centre : centres) {
    core.centres.push_back(mesh.points[centre]);
    for (const TetId t : around.of(centre)) {
      for (const VertexId v : mesh.tets[t]) {
        core.fixed[v] = 1;
      }
    }
  }
  MaterialMesh merged = mesh;
  merge_stars(merged, mix, centres);
  core.cells_saved = mesh.cell_count() - merged.cell_count();
  return core;
}

MixReport merge_hex_core(MaterialMesh& mesh, const HexCore& core, const MixOptions& mix) {
  return merge_stars(mesh, mix, vertices_at(mesh.points, core.centres));
}

}  // namespace cbc3d
