#include "mesher/stages/improve_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/core/progress.hpp"
#include "mesher/improve/edge_collapse.hpp"
#include "mesher/improve/edge_removal.hpp"
#include "mesher/improve/mesh_patches.hpp"
#include "mesher/improve/tet_shape.hpp"
#include "mesher/improve/vertex_moves.hpp"

namespace cbc3d {
namespace {

double worst_sine_squared(const MaterialMesh& mesh) {
  double worst = 1;
#pragma omp parallel for schedule(static) reduction(min : worst)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    worst = std::min(worst, min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]],
                                             mesh.points[n[3]]));
  }
  return worst;
}

/// Volume of every material, and the area of its surface.
struct Extent {
  std::vector<double> volume_mm3, area_mm2;
};

Extent extent_of_materials(const MaterialMesh& mesh, std::size_t materials) {
  Extent extent{std::vector<double>(materials, 0.0), std::vector<double>(materials, 0.0)};
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    const MaterialId m = mesh.materials[t];
    extent.volume_mm3[m] +=
        six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
    for (std::size_t f = 0; f < 4; ++f) {
      if (neighbours[t][f] == kNoTet || mesh.materials[neighbours[t][f]] != m) {
        const auto& face = kTetFace[f];
        const Vec3& p = mesh.points[n[face[0]]];
        extent.area_mm2[m] +=
            0.5 * (mesh.points[n[face[1]]] - p).cross(mesh.points[n[face[2]]] - p).norm();
      }
    }
  }
  return extent;
}

/// Moves the boundaries outwards by what each material lacks in volume, at most half a voxel in all.
void correct_volumes(const MaterialMesh& mesh, const LabelImage& image, ImageBoundary& boundary) {
  const Vec3& spacing = image.frame.spacing_mm;
  const double voxel_mm3 = spacing.x * spacing.y * spacing.z;
  const double most_mm = 0.5 * std::cbrt(voxel_mm3);
  const Extent extent = extent_of_materials(mesh, image.material_count());
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  std::vector<double> offsets = boundary.offsets();
  for (std::size_t m = 1; m < offsets.size(); ++m) {
    if (extent.area_mm2[m] > 0) {
      const double lack = static_cast<double>(voxels[m]) * voxel_mm3 - extent.volume_mm3[m];
      offsets[m] = std::clamp(offsets[m] + lack / extent.area_mm2[m], -most_mm, most_mm);
    }
  }
  boundary.set_offsets(std::move(offsets));
}

/// Looks for hosts of the points that have none; vertices that moved to the boundary may be near now.
void find_hosts(const MaterialMesh& mesh, const std::vector<InterfacePoint>& points, double reach_mm,
                std::vector<VertexId>& hosts) {
  std::vector<PointId> without;
  std::vector<InterfacePoint> wanted;
  for (PointId p = 0; p < points.size(); ++p) {
    if (hosts[p] == kNoVertex) {
      without.push_back(p);
      wanted.push_back(points[p]);
    }
  }
  if (without.empty()) {
    return;
  }
  const auto sets = vertex_materials(mesh.tets, mesh.materials,
                                     tet_neighbours(mesh.tets, mesh.points.size()), mesh.points.size());
  const std::vector<VertexId> found = nearest_hosts(wanted, mesh.points, sets, reach_mm);
  for (std::size_t i = 0; i < found.size(); ++i) {
    hosts[without[i]] = found[i];
  }
}

double degrees(double sine_squared) {
  return sine_squared <= 0 ? 0 : std::asin(std::sqrt(std::min(1.0, sine_squared))) * 180 / std::numbers::pi;
}

}  // namespace

ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  ImproveReport report;
  report.tets_before = mesh.tets.size();
  report.min_dihedral_before_deg = degrees(worst_sine_squared(mesh));
  const double diagonal = image.frame.voxel_diagonal_mm();
  ImageBoundary boundary(image, options.boundary);
  const double reach = options.reach_diagonals * diagonal;
  const auto timed = [&](const std::string& name, const auto& part) {
    const Stopwatch watch;
    part();
    report.part_seconds.emplace_back(name, watch.seconds());
  };

  std::vector<InterfacePoint> points;
  std::vector<VertexId> hosts;
  timed("hosts", [&] {
    points = interface_points(image);
    hosts.assign(points.size(), kNoVertex);
    find_hosts(mesh, points, reach, hosts);
  });
  report.boundary_points = points.size();
  report.uncovered_points = static_cast<std::size_t>(std::count(hosts.begin(), hosts.end(), kNoVertex));

  std::fprintf(stderr, "points %zu uncovered %zu\n", points.size(), report.uncovered_points);
  PatchRules rules{boundary, {options.deviation_diagonals * diagonal, diagonal}, points, reach};
  const double goal = sine_squared_of_deg(options.min_dihedral_deg + 1e-3);
  const double good = sine_squared_of_deg(35);
  const double threshold = sine_squared_of_deg(options.decimate_dihedral_deg);
  int round = 0;
  const auto in_patches = [&](const std::string& name, const auto& improve) {
    on_round(round);
    timed(name, [&] { improve_in_patches(mesh, hosts, rules, round++, improve); });
    {
      const auto nb = tet_neighbours(mesh.tets, mesh.points.size());
      std::vector<double> dev(mesh.points.size(), -1);
      for (std::size_t t = 0; t < mesh.tets.size(); ++t) for (int n = 0; n < 4; ++n) {
        MaterialId o = nb[t][n] == kNoTet ? 0 : mesh.materials[nb[t][n]];
        if (o < mesh.materials[t]) for (auto f : kTetFace[n]) { VertexId v = mesh.tets[t][f]; dev[v] = std::max(dev[v], boundary.sample(mesh.points[v], mesh.materials[t], o).deviation_mm); }
      }
      std::size_t c[5] = {0,0,0,0,0};
      for (double d : dev) { if (d >= 0) ++c[0]; d /= diagonal; if (d > .16) ++c[1]; if (d > .5) ++c[2]; if (d > 1) ++c[3]; if (d > 1e9) ++c[4]; }
      std::fprintf(stderr, "   surface vertices %zu, >.16: %zu >.5: %zu >1: %zu inf: %zu\n", c[0], c[1], c[2], c[3], c[4]);
    }
    std::fprintf(stderr, "%s %zu tets %.2f deg %.2f s\n", name.c_str(), mesh.tets.size(),
                 degrees(worst_sine_squared(mesh)), report.part_seconds.back().second);
  };

  const RelaxOptions relax{options.surface_weight, 0.5, 0.01 * diagonal};
  for (int i = 0; i < 2; ++i) {
    in_patches("relax", [&](Patch& patch) {
      relax_vertices(patch, relax);
      relax_vertices(patch, relax);
      remove_edges(patch, good);
      flatten_interfaces(patch, threshold);
      relax_vertices(patch, relax);
      pull_strays(patch, relax);
    });
    timed("hosts", [&] { find_hosts(mesh, points, reach, hosts); });
    timed("volumes", [&] { correct_volumes(mesh, image, boundary); });
    std::fprintf(stderr, "without host %zd\n", std::count(hosts.begin(), hosts.end(), kNoVertex));
  }
  for (int i = 0; i < options.decimation_rounds; ++i) {
    in_patches("decimate", [&](Patch& patch) {
      collapse_edges(patch, {threshold, 2.5, 0, false});
      remove_edges(patch, good);
      flatten_interfaces(patch, threshold);
      relax_vertices(patch, relax);
      relax_vertices(patch, relax);
      flatten_interfaces(patch, threshold);
      collapse_edges(patch, {threshold, 2.5, 0, false});
      relax_vertices(patch, relax);
      pull_strays(patch, relax);
      remove_edges(patch, good);
      flatten_interfaces(patch, threshold);
    });
    timed("hosts", [&] { find_hosts(mesh, points, reach, hosts); });
    timed("volumes", [&] { correct_volumes(mesh, image, boundary); });
    std::fprintf(stderr, "without host %zd\n", std::count(hosts.begin(), hosts.end(), kNoVertex));
  }
  for (int i = 0; i < options.repair_rounds && worst_sine_squared(mesh) < goal; ++i) {
    // What is left is rare and stuck; from round to round it may give up a little more of the distances.
    rules.guards.deviation_mm = std::min(0.45, options.deviation_diagonals + 0.05 * i) * diagonal;
    rules.reach_mm = std::min(1.05, options.reach_diagonals + 0.05 * i) * diagonal;
    in_patches("repair", [&](Patch& patch) {
      for (int k = 0; k < 3; ++k) {
        climb_vertices(patch, goal);
        remove_edges(patch, goal);
        collapse_edges(patch, {goal, 2.5, 0, true});
      }
      climb_vertices(patch, goal);
    });
  }
  drop_unused_vertices(mesh);
  report.tets_after = mesh.tets.size();
  report.min_dihedral_after_deg = degrees(worst_sine_squared(mesh));
  return report;
}

}  // namespace cbc3d
