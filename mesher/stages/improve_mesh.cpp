#include "mesher/stages/improve_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/core/progress.hpp"
#include "mesher/improve/edge_collapse.hpp"
#include "mesher/improve/edge_removal.hpp"
#include "mesher/improve/mesh_patches.hpp"
#include "mesher/improve/surface_crossings.hpp"
#include "mesher/improve/tet_shape.hpp"
#include "mesher/improve/vertex_moves.hpp"

namespace cbc3d {
namespace {

double worst_sine_squared(const MaterialMesh& mesh) {
  double worst = 1;
#pragma omp parallel for schedule(static) reduction(min : worst)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    worst = std::min(
        worst, min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]));
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
        extent.area_mm2[m] += 0.5 * (mesh.points[n[face[1]]] - p).cross(mesh.points[n[face[2]]] - p).norm();
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
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  const std::vector<VertexId> found = nearest_hosts(wanted, mesh.points, sets, reach_mm);
  for (std::size_t i = 0; i < found.size(); ++i) {
    hosts[without[i]] = found[i];
  }
}

double degrees(double sine_squared) {
  return sine_squared <= 0 ? 0 : std::asin(std::sqrt(std::min(1.0, sine_squared))) * 180 / std::numbers::pi;
}

/// The schedule: rounds in patches, and between them what needs the whole mesh.
class Improver {
 public:
  Improver(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
           const std::function<void(int)>& on_round)
      : mesh_(mesh),
        image_(image),
        options_(options),
        on_round_(on_round),
        diagonal_mm_(image.frame.voxel_diagonal_mm()),
        reach_mm_(options.reach_mm > 0 ? options.reach_mm : 0.9 * diagonal_mm_),
        goal_(sine_squared_of_deg(options.min_dihedral_deg + kMarginDeg)),
        boundary_(image, options.boundary),
        relax_{options.surface_weight, 0.5, 0.01 * diagonal_mm_},
        longest_mm_(image.material_count(), std::numeric_limits<double>::infinity()) {
    for (std::size_t m = 1; m < longest_mm_.size(); ++m) {
      const auto size = options.size_mm.find(image.labels[m]);
      longest_mm_[m] = size != options.size_mm.end() ? size->second : longest_mm_[m];
    }
  }

  ImproveReport run() {
    report_.tets_before = mesh_.tets.size();
    report_.min_dihedral_before_deg = degrees(worst_sine_squared(mesh_));
    timed("hosts", [&] {
      points_ = interface_points(image_);
      hosts_.assign(points_.size(), kNoVertex);
    });
    find_hosts_and_volumes();
    for (int i = 0; i < 2; ++i) {
      fit();
    }
    for (int i = 0; i < options_.decimation_rounds; ++i) {
      decimate();
    }
    for (int i = 0; i < options_.repair_rounds && worst_sine_squared(mesh_) < goal_; ++i) {
      repair(i);
    }
    drop_unused_vertices(mesh_);
    order_for_locality(mesh_);
    timed("crossings", [this] {
      report_.crossings_left = separate_crossings(mesh_, {0.08 * diagonal_mm_, goal_, 12});
    });
    finish();
    return std::move(report_);
  }

 private:
  static constexpr double kMarginDeg = 1e-3;  // rounding when the mesh is written must not undo the goal
  static constexpr double kGoodDeg = 35;      // tets worse than this are worth the try of an edge removal
  static constexpr double kLongestGrowth = 2.5;

  /// Vertices to the boundary, tets into shape.
  void fit() {
    in_patches("fitting", reach_mm_, options_.deviation_diagonals, [this](Patch& patch) {
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      pull_strays(patch, relax_);
    });
    find_hosts_and_volumes();
  }

  void decimate() {
    const CollapseOptions collapse{goal_, kLongestGrowth, &longest_mm_, false};
    in_patches("decimation", reach_mm_, options_.deviation_diagonals, [&](Patch& patch) {
      collapse_edges(patch, collapse);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      flatten_interfaces(patch, goal_);
      collapse_edges(patch, collapse);
      relax_vertices(patch, relax_);
      pull_strays(patch, relax_);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
    });
    find_hosts_and_volumes();
  }

  /// The worst angles. They are rare and stuck: from round to round they may cost a little more distance.
  void repair(int round) {
    const double reach_mm =
        std::max(reach_mm_, std::min(1.05 * diagonal_mm_, reach_mm_ + 0.05 * round * diagonal_mm_));
    const double deviation =
        std::max(options_.deviation_diagonals, std::min(0.4, options_.deviation_diagonals + 0.05 * round));
    in_patches("repair", reach_mm, deviation, [this](Patch& patch) {
      for (int turn = 0; turn < 3; ++turn) {
        climb_vertices(patch, goal_);
        remove_edges(patch, goal_);
        collapse_edges(patch, {goal_, kLongestGrowth, nullptr, true});
      }
      climb_vertices(patch, goal_);
    });
  }

  template <typename Improve>
  void in_patches(const std::string& name, double reach_mm, double deviation_diagonals,
                  const Improve& improve) {
    on_round_(round_);
    const PatchRules rules{boundary_, {deviation_diagonals * diagonal_mm_, diagonal_mm_}, points_, reach_mm};
    timed(name, [&] { improve_in_patches(mesh_, hosts_, rules, round_++, improve); });
  }

  void find_hosts_and_volumes() {
    timed("hosts", [this] { find_hosts(mesh_, points_, reach_mm_, hosts_); });
    if (round_ > 0) {
      timed("volumes", [this] { correct_volumes(mesh_, image_, boundary_); });
    }
  }

  template <typename Part>
  void timed(const std::string& name, const Part& part) {
    const Stopwatch watch;
    part();
    const auto known = std::find_if(report_.part_seconds.begin(), report_.part_seconds.end(),
                                    [&](const auto& p) { return p.first == name; });
    if (known == report_.part_seconds.end()) {
      report_.part_seconds.emplace_back(name, watch.seconds());
    } else {
      known->second += watch.seconds();
    }
  }

  void finish() {
    report_.boundary_points = points_.size();
    report_.uncovered_points = static_cast<std::size_t>(std::count(hosts_.begin(), hosts_.end(), kNoVertex));
    report_.rounds = round_;
    report_.tets_after = mesh_.tets.size();
    report_.min_dihedral_after_deg = degrees(worst_sine_squared(mesh_));
  }

  MaterialMesh& mesh_;
  const LabelImage& image_;
  const ImproveOptions& options_;
  const std::function<void(int)>& on_round_;
  double diagonal_mm_, reach_mm_, goal_;
  ImageBoundary boundary_;
  RelaxOptions relax_;
  std::vector<double> longest_mm_;  // edges of each material
  std::vector<InterfacePoint> points_;
  std::vector<VertexId> hosts_;
  int round_ = 0;
  ImproveReport report_;
};

}  // namespace

ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  return Improver(mesh, image, options, on_round).run();
}

}  // namespace cbc3d
