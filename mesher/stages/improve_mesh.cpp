#include "mesher/stages/improve_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/core/progress.hpp"
#include "mesher/improve/edge_collapse.hpp"
#include "mesher/improve/edge_removal.hpp"
#include "mesher/improve/edge_split.hpp"
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

/// Points with their hosts, and the reach of those that none was within reach of.
struct Hosted {
  std::vector<InterfacePoint> points;
  std::vector<VertexId> hosts;
  std::vector<float> far_reach_mm;
  double reach_mm;
};

/// What no vertex of both materials is near goes to the nearest surface vertex of its own one, and is to stay as
/// near to one as that: the points without host otherwise grow lonelier unseen.
void host_far_points(const MaterialMesh& mesh, const std::vector<MaterialSet>& sets, double reach_mm,
                     double leeway_mm, Hosted& hosted) {
  hosted.far_reach_mm.assign(hosted.points.size(), 0);
  std::vector<std::size_t> lost;
  for (std::size_t p = 0; p < hosted.points.size(); ++p) {
    if (hosted.hosts[p] == kNoVertex) {
      hosted.points[p].other = hosted.points[p].own;
      lost.push_back(p);
    }
  }
  for (int doubling = 0; doubling < 12 && !lost.empty(); ++doubling, reach_mm *= 2) {
    std::vector<InterfacePoint> points;
    for (const std::size_t p : lost) {
      points.push_back(hosted.points[p]);
    }
    const std::vector<VertexId> hosts = nearest_hosts(points, mesh.points, sets, reach_mm);
    std::vector<std::size_t> still_lost;
    for (std::size_t i = 0; i < lost.size(); ++i) {
      if (hosts[i] == kNoVertex) {
        still_lost.push_back(lost[i]);
        continue;
      }
      hosted.hosts[lost[i]] = hosts[i];
      const double distance_mm = (mesh.points[hosts[i]] - points[i].centre()).norm();
      hosted.far_reach_mm[lost[i]] = static_cast<float>(distance_mm + leeway_mm);
    }
    lost = std::move(still_lost);
  }
}

Hosted find_hosts(const MaterialMesh& mesh, const ImproveTarget& target, ImproveReport& report) {
  if (!target.hosts.empty()) {
    report.boundary_points = target.points.size();
    return {target.points, target.hosts, {}, target.reach_mm};
  }
  Hosted hosted{target.points, {}, {}, target.reach_mm};
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  const auto sets = vertex_materials(mesh.tets, mesh.materials, neighbours, mesh.points.size());
  hosted.hosts = nearest_hosts(hosted.points, mesh.points, sets, target.reach_mm);
  report.boundary_points = hosted.points.size();
  report.uncovered_points =
      static_cast<std::size_t>(std::count(hosted.hosts.begin(), hosted.hosts.end(), kNoVertex));
  if (target.keep_distances) {
    const double leeway_mm = 0.05 * target.scale_mm;
    double farthest_mm = 0;
    for (std::size_t p = 0; p < hosted.points.size(); ++p) {
      if (hosted.hosts[p] != kNoVertex) {
        farthest_mm = std::max(farthest_mm, (mesh.points[hosted.hosts[p]] - hosted.points[p].centre()).norm());
      }
    }
    host_far_points(mesh, sets, target.reach_mm, leeway_mm, hosted);
    hosted.reach_mm = std::min(hosted.reach_mm, farthest_mm + leeway_mm);
  }
  return hosted;
}

double degrees(double sine_squared) {
  return sine_squared <= 0 ? 0 : std::asin(std::sqrt(std::min(1.0, sine_squared))) * 180 / std::numbers::pi;
}

}  // namespace

ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  const double diagonal = image.frame.voxel_diagonal_mm();
  ImageBoundary boundary(image, options.boundary);
  const std::vector<InterfacePoint> points = interface_points(image);
  const ImproveTarget target{boundary, points, diagonal, options.deviation_diagonals * diagonal,
                             options.reach_diagonals * diagonal, options.keep_distances,
                             [&](const MaterialMesh& now) { correct_volumes(now, image, boundary); }};
  return improve_mesh(mesh, target, options, on_round);
}

ImproveReport improve_mesh(MaterialMesh& mesh, const ImproveTarget& target, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  ImproveReport report;
  report.tets_before = mesh.tets.size();
  report.min_dihedral_before_deg = degrees(worst_sine_squared(mesh));
  const double diagonal = target.scale_mm;
  const auto timed = [&](const std::string& name, const auto& part) {
    const Stopwatch watch;
    part();
    report.part_seconds.emplace_back(name, watch.seconds());
  };

  Hosted hosted{};
  timed("hosts", [&] { hosted = find_hosts(mesh, target, report); });

  PatchRules rules{target.boundary, {target.deviation_mm, diagonal}, hosted.points, hosted.reach_mm};
  rules.far_reach_mm = hosted.far_reach_mm;
  const double goal = sine_squared_of_deg(options.min_dihedral_deg);
  const double good = sine_squared_of_deg(35);
  const double threshold = sine_squared_of_deg(options.decimate_dihedral_deg);
  int round = 0;
  const auto in_patches = [&](const std::string& name, const auto& improve) {
    on_round(round);
    timed(name, [&] { improve_in_patches(mesh, hosted.hosts, rules, round++, improve); });
  };

  const auto correct = [&] {
    if (target.correct) {
      timed("volumes", [&] { target.correct(mesh); });
    }
  };

  bool may_split = false;
  const auto repair = [&](Patch& patch) {
    for (int k = 0; k < 3; ++k) {
      climb_vertices(patch, goal);
      remove_edges(patch, goal);
      collapse_edges(patch, {goal, 2.5, 0, true});
      if (may_split && k == 1) {
        split_edges(patch, goal);
      }
    }
    climb_vertices(patch, goal);
  };
  // The first rounds stay close to the bad tets, which may be many; what resists gets more room.
  const auto near_bad = [&](const std::string& name, double below, int rings) {
    std::size_t bad = 0;
    on_round(round);
    timed(name, [&] { bad = improve_near_bad_tets(mesh, hosted.hosts, rules, round++, below, rings, repair); });
    return bad;
  };
  for (int i = 0; i < options.untangle_rounds && near_bad("untangle", 0, i + 1) > 0; ++i) {
  }
  const RelaxOptions relax{options.surface_weight, 0.5, 0.01 * diagonal};
  for (int i = 0; i < (options.only_bad ? 0 : 2); ++i) {
    in_patches("relax", [&](Patch& patch) {
      relax_vertices(patch, relax);
      relax_vertices(patch, relax);
      remove_edges(patch, good);
      flatten_interfaces(patch, threshold);
      relax_vertices(patch, relax);
      pull_strays(patch, relax);
    });
    correct();
  }
  for (int i = 0; i < (options.only_bad ? 0 : options.decimation_rounds); ++i) {
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
    correct();
  }
  for (int i = 0; i < options.repair_rounds && near_bad("repair", goal, std::min(4, i + 1)) > 0; ++i) {
    may_split = true;  // only where all else has failed
  }
  drop_unused_vertices(mesh);
  report.tets_after = mesh.tets.size();
  report.min_dihedral_after_deg = degrees(worst_sine_squared(mesh));
  return report;
}

}  // namespace cbc3d
