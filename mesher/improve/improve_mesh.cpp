#include "mesher/improve/improve_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/core/stage_clock.hpp"
#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/edge_split.hpp"
#include "mesher/improve/local/graded_sizes.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/surface_repair.hpp"
#include "mesher/improve/surface/volume_correction.hpp"

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

double voxel_volume_mm3(const LabelImage& image) {
  const Vec3& spacing = image.frame.spacing_mm;
  return spacing.x * spacing.y * spacing.z;
}

/// Of the voxels; 0 for background.
std::vector<double> volumes_of_materials(const LabelImage& image) {
  std::vector<double> volumes(image.material_count(), 0.0);
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  for (std::size_t m = 1; m < volumes.size(); ++m) {
    volumes[m] = static_cast<double>(voxels[m]) * voxel_volume_mm3(image);
  }
  return volumes;
}

/// Moves the boundaries outwards by what each material lacks in volume, at most half a voxel in all.
/// Where the last correction (`lacks_mm3`, renewed) brought less than it should have, this one is larger.
void correct_volumes(const MaterialMesh& mesh, const LabelImage& image, const std::vector<double>& wanted_mm3,
                     std::vector<double>& lacks_mm3, ImageBoundary& boundary) {
  constexpr double kLargestFactor = 3;
  const double most_mm = 0.5 * std::cbrt(voxel_volume_mm3(image));
  const Extent extent = extent_of_materials(mesh, image.material_count());
  std::vector<double> offsets = boundary.offsets();
  for (std::size_t m = 1; m < offsets.size(); ++m) {
    if (extent.area_mm2[m] > 0) {
      const double lack = wanted_mm3[m] - extent.volume_mm3[m];
      const double left = lacks_mm3[m] != 0 ? lack / lacks_mm3[m] : 0;
      const double factor = left > 0 && left < 1 ? std::min(kLargestFactor, 1 / (1 - left)) : 1;
      offsets[m] = std::clamp(offsets[m] + factor * lack / extent.area_mm2[m], -most_mm, most_mm);
      lacks_mm3[m] = lack;
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

/// What no vertex of both materials is near goes to the nearest surface vertex of its own one, and is to stay
/// as near to one as that: the points without host otherwise grow lonelier unseen.
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
    points.reserve(lost.size());
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

/// Thin parts keep their vertices nearer, but for what is farther as it is.
void host_thin_points(const MaterialMesh& mesh, const ImproveTarget& target, Hosted& hosted) {
  hosted.far_reach_mm.assign(hosted.points.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < hosted.points.size(); ++p) {
    if (hosted.hosts[p] != kNoVertex && target.is_thin(hosted.points[p])) {
      const double distance_mm = (mesh.points[hosted.hosts[p]] - hosted.points[p].centre()).norm();
      hosted.far_reach_mm[p] = static_cast<float>(std::max(target.thin_reach_mm, 1.05 * distance_mm));
    }
  }
}

/// True when a voxel is in no 2x2x2 block of its own label.
bool is_thin_at(const LabelImage& image, const Index3& at) {
  const MaterialId own = image.at_or_background(at[0], at[1], at[2]);
  for (int block = 0; block < 8; ++block) {
    bool whole = true;
    for (int corner = 0; corner < 8 && whole; ++corner) {
      whole = image.at_or_background(at[0] - (block & 1) + (corner & 1),
                                     at[1] - (block >> 1 & 1) + (corner >> 1 & 1),
                                     at[2] - (block >> 2) + (corner >> 2)) == own;
    }
    if (whole) {
      return false;
    }
  }
  return true;
}

/// True when a point's voxel is thin, or one across its interface.
bool is_thin(const LabelImage& image, const InterfacePoint& point) {
  Index3 at{};
  for (int axis = 0; axis < 3; ++axis) {
    at[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::lround(point.centre()[axis] / image.frame.spacing_mm[axis]));
  }
  if (is_thin_at(image, at)) {
    return true;
  }
  for (std::size_t side = 0; side < 6 && point.other == kBackground; ++side) {
    Index3 next = at;
    next[side / 2] += side % 2 == 0 ? 1 : -1;
    if (image.at_or_background(next[0], next[1], next[2]) == point.other && is_thin_at(image, next)) {
      return true;
    }
  }
  return false;
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
  if (target.keep_distances) {
    const double leeway_mm = 0.05 * target.scale_mm;
    double farthest_mm = 0;
    for (std::size_t p = 0; p < hosted.points.size(); ++p) {
      if (hosted.hosts[p] != kNoVertex) {
        farthest_mm =
            std::max(farthest_mm, (mesh.points[hosted.hosts[p]] - hosted.points[p].centre()).norm());
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

/// Looks again for hosts of the points that have none; vertices that have moved to the boundary may be near
/// now.
void find_missing_hosts(const MaterialMesh& mesh, Hosted& hosted) {
  std::vector<std::size_t> without;
  std::vector<InterfacePoint> wanted;
  for (std::size_t p = 0; p < hosted.points.size(); ++p) {
    if (hosted.hosts[p] == kNoVertex) {
      without.push_back(p);
      wanted.push_back(hosted.points[p]);
    }
  }
  if (without.empty()) {
    return;
  }
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  const auto sets = vertex_materials(mesh.tets, mesh.materials, neighbours, mesh.points.size());
  const std::vector<VertexId> found = nearest_hosts(wanted, mesh.points, sets, hosted.reach_mm);
  for (std::size_t i = 0; i < found.size(); ++i) {
    hosted.hosts[without[i]] = found[i];
  }
}

/// The schedule: rounds in patches, and between them what needs the whole mesh.
class Improver {
 public:
  Improver(MaterialMesh& mesh, const ImproveTarget& target, const ImproveOptions& options,
           const std::function<void(int)>& on_round)
      : mesh_(mesh),
        target_(target),
        options_(options),
        on_round_(on_round),
        goal_(sine_squared_of_deg(options.min_dihedral_deg + kMarginDeg)),
        relax_{options.surface_weight, 0.5, 0.01 * target.scale_mm, options.smoothness,
               options.smoothness_cap_mm > 0
                   ? options.smoothness_cap_mm
                   : std::min(target.deviation_mm, kSmoothnessCap * target.scale_mm)} {}

  ImproveReport run() {
    report_.tets_before = mesh_.tets.size();
    report_.min_dihedral_before_deg = degrees(worst_sine_squared(mesh_));
    timed("hosts", [this] { hosted_ = find_hosts(mesh_, target_, report_); });
    for (int i = 0; i < options_.untangle_rounds && repair("untangling", 0, i) > 0; ++i) {
    }
    if (!options_.only_bad) {
      fit();
      if (target_.is_thin && !target_.keep_distances) {
        host_thin_points(mesh_, target_, hosted_);
      }
      thin_out();
      for (int i = 0; i < kSettlings && (i == 0 || largest_lack() > kLargestLack); ++i) {
        settle();
      }
    }
    for (int i = 0; i < options_.repair_rounds && repair("repair", goal_, i) > 0; ++i) {
    }
    if (!options_.only_bad) {
      finish_surfaces();
    }
    drop_unused_vertices(mesh_);
    if (!options_.only_bad) {
      order_for_locality(mesh_);
    }
    finish();
    return std::move(report_);
  }

 private:
  static constexpr double kMarginDeg = 1e-3;     // rounding when the mesh is written must not undo the goal
  static constexpr double kGoodDeg = 35;         // tets worse than this are worth the try of an edge removal
  static constexpr double kSmoothnessCap = 0.2;  // in the target's scale, by default: farther is no flatter
  static constexpr double kLongestGrowth = 5;
  static constexpr double kVolumeShare = 0.05;   // that a collapse may take from a material round it
  static constexpr int kSettlings = 10;          // at most
  static constexpr int kBalances = 6;            // of the volumes in the end, at most
  static constexpr double kLargestLack = 0.004;  // of a volume, after which no more are needed
  static constexpr double kSmallChanges = 60;    // volumes of so many largest changes do not count
  static constexpr double kFewerShare = 0.97;    // a round of decimation that leaves more is the last
  static constexpr int kLastRepairs = 8;
  static constexpr int kFarRepair = 4;  // the round of a repair from which on all its leeway is given
  static constexpr double kFarthestReach =
      1.08;                               // of a vertex, in the target's scale, where nothing else helps
  static constexpr double kLimit = 1.09;  // of distances in the end, likewise

  /// Vertices to the boundary, tets into shape.
  void fit() {
    in_patches("fitting", [this](Patch& patch) {
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      project_far_vertices(patch, relax_);
    });
  }

  /// Of a material's volume, the largest share that is missing or too much; small ones do not count.
  [[nodiscard]] double largest_lack() const {
    if (target_.volumes_mm3.empty()) {
      return 0;
    }
    const Extent extent = extent_of_materials(mesh_, target_.volumes_mm3.size());
    double largest = 0;
    for (std::size_t m = 1; m < target_.volumes_mm3.size(); ++m) {
      const double wanted = target_.volumes_mm3[m];
      if (wanted > kSmallChanges * target_.largest_change_mm3) {
        largest = std::max(largest, std::fabs(wanted - extent.volume_mm3[m]) / wanted);
      }
    }
    return largest;
  }

  /// The volumes after the last round are known only now.
  void settle() {
    in_patches("settling", [this](Patch& patch) {
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
    });
  }

  /// Rounds of decimation as long as they are worth it.
  void thin_out() {
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < options_.decimation_rounds; ++i) {
      const auto tets = static_cast<double>(mesh_.tets.size());
      if (tets > kFewerShare * before) {
        return;
      }
      before = tets;
      decimate();
    }
  }

  [[nodiscard]] double collapse_deg() const {
    return std::max(options_.min_dihedral_deg - options_.collapse_leeway_deg,
                    0.5 * options_.min_dihedral_deg);
  }

  void decimate() {
    const bool graded = options_.gradation >= 0;
    CollapseOptions collapse{sine_squared_of_deg(collapse_deg()), kLongestGrowth,
                             target_.longest_mm.empty() ? nullptr : &target_.longest_mm, false, graded};
    collapse.optimize_position = true;
    collapse.volume_share = kVolumeShare;
    if (graded) {
      sizes_ = graded_sizes(mesh_, options_.gradation);
    }
    in_patches("decimation", [&](Patch& patch) {
      collapse_edges(patch, collapse);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      flatten_interfaces(patch, goal_);
      collapse_edges(patch, collapse);
      relax_vertices(patch, relax_);
      project_far_vertices(patch, relax_);
      remove_edges(patch, sine_squared_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      climb_vertices(patch, goal_);
    });
    sizes_.clear();
  }

  /// The tets worse than `below`, and what is round them; returns how many there are. They are rare and
  /// stuck: from round to round more round them may move, edges may be split, and, unless the distances are
  /// to be kept, a little more distance is given away.
  std::size_t repair(const std::string& name, double below, int round) {
    PatchRules rules = rules_now();
    if (!target_.keep_distances) {
      const double unit = target_.scale_mm;
      rules.reach_mm =
          std::max(rules.reach_mm, std::min(kFarthestReach * unit, rules.reach_mm + 0.05 * round * unit));
      double& deviation_mm = rules.guards.deviation_mm;
      deviation_mm = std::max(deviation_mm, std::min(0.5 * unit, deviation_mm + 0.05 * round * unit));
    }
    on_round_(round_);
    std::size_t bad = 0;
    timed(name, [&] {
      bad = improve_near_bad_tets(mesh_, hosted_.hosts, rules, round_++, below, std::min(4, round + 1),
                                  [&](Patch& patch) { repair_patch(patch, below > 0 ? round : 0); });
    });
    return bad;
  }

  /// From the second round on edges may be split; later the vertices are shaken up before.
  void repair_patch(Patch& patch, int round) const {
    for (int turn = 0; turn < 3; ++turn) {
      if (round >= kFarRepair && turn == 1) {
        RelaxOptions loose = relax_;
        loose.surface_weight *= 0.03;
        relax_vertices(patch, loose);
      }
      climb_vertices(patch, goal_);
      remove_edges(patch, goal_);
      collapse_edges(patch, {goal_, kLongestGrowth, nullptr, true});
      if (round > 0 && turn == 1) {
        split_edges(patch, goal_);
      }
    }
    climb_vertices(patch, goal_);
  }

  /// Crossings, strays and volumes. Where tets have changed hands, bad ones may move that were stuck before;
  /// what still crosses in the end may cost a little more distance, and what then is left is mended place by
  /// place.
  void finish_surfaces() {
    with_points(hosted_.reach_mm, [this](CoveredSamples& hosted) { separate_and_relabel(hosted); });
    for (int i = 0;
         report_.tets_relabelled > 0 && i < kLastRepairs && repair("repair", goal_, kFarRepair + i) > 0;
         ++i) {
    }
    for (int i = 0; i < kBalances && (i == 0 || largest_lack() > kLargestLack); ++i) {
      balance_and_separate();
    }
    const bool may_mend = target_.places.is_near && !target_.keep_distances;
    if (may_mend && (may_have_faults_ || has_lonely_points() || have_labels_crossings())) {
      timed("mending", [this] { mend(); });
    }
  }

  /// What the volumes gain may touch something, and what is drawn apart is missing from the volumes.
  void balance_and_separate() {
    if (!target_.volumes_mm3.empty()) {
      with_points(hosted_.reach_mm,
                  [this](CoveredSamples& hosted) { timed("volumes", [&] { balance(hosted); }); });
    }
    const double farthest_mm = std::max(hosted_.reach_mm, kFarthestReach * target_.scale_mm);
    with_points(target_.keep_distances ? hosted_.reach_mm : farthest_mm,
                [this](CoveredSamples& hosted) { separate_and_relabel(hosted); });
  }

  /// True when a point may have no surface vertex of its own material within the limit.
  [[nodiscard]] bool has_lonely_points() const {
    const double limit_squared = kLimit * kLimit * target_.scale_mm * target_.scale_mm;
    bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
    for (std::size_t p = 0; p < hosted_.points.size(); ++p) {
      const VertexId host = hosted_.hosts[p];
      any = any || host == kNoVertex ||
            (mesh_.points[host] - hosted_.points[p].centre()).squared_norm() > limit_squared;
    }
    return any;
  }

  [[nodiscard]] bool have_labels_crossings() const {
    return count_crossings_of_labels(mesh_, target_.places.label_of) > 0;
  }

  void mend() {
    MendOptions options;
    options.limit_mm = kLimit * target_.scale_mm;
    options.step_mm = target_.scale_mm;
    options.largest_mm3 = target_.largest_change_mm3;
    options.goal_sine_squared = goal_;
    const MendReport report = mend_surfaces(mesh_, target_.points, target_.places, options);
    report_.tets_relabelled += report.tets_relabelled;
    report_.crossings_left = report.cuts_left;
    report_.faults_left = report.faults_left;
  }

  template <typename Step>
  void with_points(double reach_mm, const Step& step) {
    CoveredSamples hosted(hosted_.points, hosted_.hosts, mesh_.points.size(), reach_mm);
    step(hosted);
  }

  /// What crosses is drawn apart; what then still does, and what stands on a wrong surface, changes hands.
  void separate_and_relabel(CoveredSamples& hosted) {
    timed("crossings", [&] { separate_and_relabel_in_turns(hosted); });
  }

  void separate_and_relabel_in_turns(CoveredSamples& hosted) {
    const CrossingOptions crossing{0.08 * target_.scale_mm, goal_, 12};
    const RelabelOptions relabel{hosted_.reach_mm, target_.largest_change_mm3, goal_, 6};
    for (int turn = 0; turn < 3; ++turn) {
      report_.crossings_left = separate_crossings(mesh_, hosted, crossing);
      if (!target_.places.is_near) {
        return;
      }
      const RelabelReport report = relabel_misplaced_tets(mesh_, hosted, target_.places, relabel);
      report_.tets_relabelled += report.tets_relabelled;
      may_have_faults_ = report.faults_left > 0;
      if (report.tets_relabelled + report.vertices_moved == 0) {
        return;
      }
    }
    may_have_faults_ = true;
    report_.crossings_left = separate_crossings(mesh_, hosted, crossing);
  }

  void balance(const CoveredSamples& hosted) {
    BalanceOptions options;
    options.wanted_mm3 = target_.volumes_mm3;
    options.label_of = target_.places.label_of;
    options.step_mm = 0.03 * target_.scale_mm;
    options.goal_sine_squared = goal_;
    balance_volumes(mesh_, hosted, options);
  }

  [[nodiscard]] PatchRules rules_now() const {
    PatchRules rules{
        target_.boundary, {target_.deviation_mm, target_.scale_mm}, hosted_.points, hosted_.reach_mm};
    rules.far_reach_mm = hosted_.far_reach_mm;
    rules.longest_mm = sizes_;
    return rules;
  }

  template <typename Improve>
  void in_patches(const std::string& name, const Improve& improve) {
    on_round_(round_);
    timed(name, [&] { improve_in_patches(mesh_, hosted_.hosts, rules_now(), round_++, improve); });
    timed("hosts", [this] { find_missing_hosts(mesh_, hosted_); });
    if (target_.correct) {
      timed("volumes", [this] { target_.correct(mesh_); });
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
    report_.uncovered_points =
        static_cast<std::size_t>(std::count(hosted_.hosts.begin(), hosted_.hosts.end(), kNoVertex));
    report_.rounds = round_;
    report_.tets_after = mesh_.tets.size();
    report_.min_dihedral_after_deg = degrees(worst_sine_squared(mesh_));
    if (!options_.only_bad && !target_.places.label_of.empty()) {
      timed("check", [this] {
        report_.crossings_left =
            std::max(report_.crossings_left, count_crossings_of_labels(mesh_, target_.places.label_of));
      });
    }
  }

  MaterialMesh& mesh_;
  const ImproveTarget& target_;
  const ImproveOptions& options_;
  const std::function<void(int)>& on_round_;
  double goal_;
  RelaxOptions relax_;
  Hosted hosted_{};
  std::vector<double> sizes_;  // of a round of decimation with a gradation
  int round_ = 0;
  bool may_have_faults_ = false;  // in the surfaces, in the end
  ImproveReport report_;
};

ImagePlaces places_of(const LabelImage& image, const ImageBoundary& boundary) {
  constexpr double kNearDiagonals = 1.09;
  return {first_of_label(image),
          [&image](const Vec3& at, MaterialId material) {
            return has_boundary_voxel_near(image, at, material,
                                           kNearDiagonals * image.frame.voxel_diagonal_mm());
          },
          [&image](const Vec3& at, MaterialId material) {
            return nearest_boundary_voxel(image, at, material, 2 * image.frame.voxel_diagonal_mm());
          },
          [&boundary](const Vec3& at) { return boundary.material_at(at); }};
}

}  // namespace

ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  const double diagonal_mm = image.frame.voxel_diagonal_mm();
  ImageBoundary boundary(image, options.boundary);
  const std::vector<InterfacePoint> points = interface_points(image);
  ImproveTarget target{boundary, points, diagonal_mm};
  target.deviation_mm = options.deviation_diagonals * diagonal_mm;
  target.reach_mm = options.reach_mm > 0 ? options.reach_mm : kReachDiagonals * diagonal_mm;
  target.longest_mm = values_of_materials(image, options.size_mm, std::numeric_limits<double>::infinity());
  target.keep_distances = options.keep_distances;
  target.is_thin = [&image](const InterfacePoint& point) { return is_thin(image, point); };
  target.thin_reach_mm = std::min(
      target.reach_mm,
      0.95 * std::max({image.frame.spacing_mm.x, image.frame.spacing_mm.y, image.frame.spacing_mm.z}));
  target.places = places_of(image, boundary);
  target.largest_change_mm3 = 8 * voxel_volume_mm3(image);
  target.volumes_mm3 = volumes_of_materials(image);
  std::vector<double> lacks_mm3(image.material_count(), 0.0);
  target.correct = [&](const MaterialMesh& now) {
    correct_volumes(now, image, target.volumes_mm3, lacks_mm3, boundary);
  };
  return improve_mesh(mesh, target, options, on_round);
}

ImproveReport improve_mesh(MaterialMesh& mesh, const ImproveTarget& target, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round) {
  return Improver(mesh, target, options, on_round).run();
}

}  // namespace cbc3d
