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
#include "mesher/improve/local/mesh_star.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/improve/part_thickness.hpp"
#include "mesher/improve/sample_cover.hpp"
#include "mesher/improve/surface/defect_removal.hpp"
#include "mesher/improve/surface/relabel_tets.hpp"
#include "mesher/improve/surface/self_intersections.hpp"
#include "mesher/improve/surface/volume_correction.hpp"
#include "mesher/improve/volume_offsets.hpp"

namespace cbc3d {
namespace {

double degrees(double sine_squared) {
  return sine_squared <= 0 ? 0 : std::asin(std::sqrt(std::min(1.0, sine_squared))) * 180 / std::numbers::pi;
}

/// The lengths that the improvement works with, mm, from the options and the domain's scale.
struct Lengths {
  double scale, reach, deviation, smoothness_cap, surface_edge;

  Lengths(const Domain& domain, const ImproveOptions& options)
      : scale(domain.scale_mm()),
        reach(options.reach_mm > 0 ? options.reach_mm : tolerances::kReach * scale),
        deviation(options.deviation_mm > 0 ? options.deviation_mm : options.deviation_diagonals * scale),
        smoothness_cap(options.smoothness_cap_mm > 0
                           ? options.smoothness_cap_mm
                           : std::min(deviation, tolerances::kSmoothnessCap * scale)),
        surface_edge(options.surface_edge_mm) {}
};

/// The schedule: rounds in patches, and between them what needs the whole mesh.
class Improver {
 public:
  Improver(MaterialMesh& mesh, const Domain& domain, const ImproveOptions& options,
           const std::function<void(int)>& on_round, std::span<const std::uint8_t> fixed)
      : mesh_(mesh),
        domain_(domain),
        options_(options),
        on_round_(on_round),
        fixed_(fixed.begin(), fixed.end()),
        goal_(quality_of_deg(options.min_dihedral_deg + kMarginDeg)),
        mm_(domain, options),
        relax_{.surface_weight = options.surface_weight,
               .max_step = 0.5,
               .skip_below_mm = tolerances::kRelaxSkip * mm_.scale,
               .smoothness = options.smoothness,
               .smoothness_cap_mm = mm_.smoothness_cap},
        longest_mm_(
            values_of_materials(domain.labels(), options.size_mm, std::numeric_limits<double>::infinity())),
        offsets_(domain) {
    for (double& longest : longest_mm_) {
      longest *= kLongestPerMean;
    }
  }

  /// The table of contents of the improvement; ALGORITHM.md explains each line.
  ImproveReport run() {
    start();
    untangle();
    if (!options_.only_bad) {
      fit();
      tighten_thin_parts();
      limit_edges_of_thin_parts();
      decimate();
      settle_volumes();
    }
    repair_angles();
    if (!options_.only_bad) {
      finish_surfaces();
    }
    drop_unused_vertices(mesh_);
    if (!options_.only_bad) {
      order_for_locality(mesh_);
    }
    finish();
    report_.part_seconds = clock_.seconds();
    return std::move(report_);
  }

 private:
  static constexpr double kMarginDeg = 1e-3;      // rounding when the mesh is written must not undo the goal
  static constexpr double kGoodDeg = 35;          // edge removal is tried at tets worse than this
  static constexpr double kLongestPerMean = 1.4;  // of edges in an even mesh
  static constexpr double kLongestGrowth = 5;     // of an edge in a collapse
  static constexpr double kGrowthAtFixed = 1.5;   // of edges that end at a fixed vertex
  static constexpr double kVolumeShare = 0.05;    // largest loss of a material around a collapse
  static constexpr int kSettlings = 10;           // at most
  static constexpr int kCorrections = 6;          // of the volumes in the last stage, at most
  static constexpr double kLargestLack = 0.004;   // share of a volume; below it no correction is needed
  static constexpr double kLargestCells =
      8;  // largest volume relabelled at one place, in cells of the domain
  static constexpr double kSmallVolumes = 60;      // volumes below this many of those are not waited for
  static constexpr double kSmoothnessShare = 0.1;  // of a material's thickness
  static constexpr int kTargetRounds = 24;         // of decimation to a number of tets, at most
  static constexpr double kCloseEnough = 1.02;     // the last steps change the number by as much
  static constexpr double kSlowShare = 0.9;        // a round that leaves more asks for greater lengths
  static constexpr double kLeastGrowth = 1.05, kMostGrowth = 1.3;  // of them, at once
  static constexpr double kLargestDeviation =
      0.8;                                     // scales; beyond, vertices are no more where their label is
  static constexpr double kFewerShare = 0.97;  // a round of decimation that leaves more is the last
  static constexpr int kLastRepairs = 8;
  static constexpr int kFarRepair = 4;  // from this round on a repair has all its leeway

  // ---- The stages, in their order

  void start() {
    report_.tets_before = mesh_.tets.size();
    report_.min_dihedral_before_deg = degrees(worst_sine_squared(mesh_));
    report_.boundary_samples = domain_.samples().size();
    clock_.time("covering",
                [this] { cover_ = cover_samples(mesh_, domain_, mm_.reach, options_.keep_distances); });
  }

  /// Tets that are flat or inside out are repaired first.
  void untangle() {
    for (int i = 0; i < options_.untangle_rounds && repair("untangling", 0, i) > 0; ++i) {
    }
  }

  /// Smoothing may wear off a share of a material's thickness alone: three times its volume over its area,
  /// which is the radius of a ball and one and a half times the thickness of a plate.
  void find_smoothness_caps() {
    const Extent extent = extent_of_materials(mesh_, domain_.labels().size());
    caps_.assign(extent.area_mm2.size(), mm_.smoothness_cap);
    for (std::size_t m = 1; m < caps_.size(); ++m) {
      if (extent.area_mm2[m] > 0) {
        caps_[m] = std::min(caps_[m], kSmoothnessShare * 3 * extent.volume_mm3[m] / extent.area_mm2[m]);
      }
    }
  }

  /// Vertices move to the boundary, tets into shape.
  void fit() {
    find_smoothness_caps();
    in_patches("fitting", [this](Patch& patch) {
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      remove_edges(patch, quality_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      project_far_vertices(patch, relax_);
    });
  }

  /// Once vertices are at the boundary, samples in thin parts have a smaller reach.
  void tighten_thin_parts() {
    if (!options_.keep_distances) {
      cover_thin_samples(mesh_, domain_, mm_.reach, cover_);
    }
  }

  /// Edges that the decimation makes there are about as long as the part is thick times a factor: longer ones
  /// would have flat tets between them, or none of their vertices inside.
  void limit_edges_of_thin_parts() {
    if (options_.edges_per_thickness > 0) {
      const double natural_mm = tolerances::kEdgesPerReach * mm_.reach;
      thin_edges_mm_ = thickness_at_vertices(mesh_, domain_, natural_mm / options_.edges_per_thickness);
      scale_thin_edges(kLongestPerMean * options_.edges_per_thickness);
    }
  }

  void scale_thin_edges(double factor) {
    for (double& longest : thin_edges_mm_) {
      longest *= factor;
    }
  }

  void decimate() { options_.target_tets > 0 ? decimate_to_target() : decimate_for_distance(); }

  /// Rounds of decimation while they reduce the number of tets enough.
  void decimate_for_distance() {
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < options_.decimation_rounds; ++i) {
      const auto tets = static_cast<double>(mesh_.tets.size());
      if (tets > kFewerShare * before) {
        return;
      }
      before = tets;
      decimate_once();
    }
  }

  /// Rounds of decimation until the tets are few enough. Where the lengths in force let a round remove few,
  /// they grow, by what tets of even size would need.
  void decimate_to_target() {
    const auto target = static_cast<double>(options_.target_tets);
    for (int i = 0; i < kTargetRounds; ++i) {
      const auto before = static_cast<double>(mesh_.tets.size());
      if (before <= kCloseEnough * target) {
        return;
      }
      least_share_ = target / before;
      decimate_once();
      const auto after = static_cast<double>(mesh_.tets.size());
      if (after > kSlowShare * before) {
        grow_lengths(std::clamp(std::sqrt(after / target), kLeastGrowth, kMostGrowth));
      }
    }
    least_share_ = 0;
  }

  /// The edges of surfaces alone, until they are as long as the distances allow.
  void grow_lengths(double factor) {
    if (mm_.surface_edge > 0) {
      mm_.surface_edge *= factor;
      if (mm_.surface_edge > tolerances::kEdgesPerReach * mm_.reach) {
        mm_.surface_edge = 0;
      }
      return;
    }
    mm_.reach *= factor;
    scale_thin_edges(factor);
    mm_.deviation = std::max(mm_.deviation, std::min(factor * mm_.deviation, kLargestDeviation * mm_.scale));
    cover_.reach_mm = mm_.reach;
  }

  void decimate_once() {
    const bool graded = options_.gradation >= 0;
    const CollapseOptions all_collapses{.threshold_quality = quality_of_deg(collapse_deg()),
                                        .longest_growth = kLongestGrowth,
                                        .longest_mm = &longest_mm_,
                                        .longest_on_surface_mm = longest_on_surface_mm(),
                                        .graded = graded,
                                        .optimize_position = true,
                                        .volume_share = kVolumeShare};
    if (graded) {
      sizes_ = graded_sizes(mesh_, options_.gradation, longest_inner_mm());
      allow_edges_at_fixed_vertices();
    }
    longest_on_interface_mm_ = thin_edges_mm_;
    in_patches("decimation", [&](Patch& patch) {
      CollapseOptions collapse = all_collapses;
      collapse.least_tets =
          static_cast<std::size_t>(least_share_ * static_cast<double>(patch.mesh.tet_slots()));
      collapse_edges(patch, collapse);
      remove_edges(patch, quality_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      relax_vertices(patch, relax_);
      relax_vertices(patch, relax_);
      flatten_interfaces(patch, goal_);
      collapse_edges(patch, collapse);
      relax_vertices(patch, relax_);
      project_far_vertices(patch, relax_);
      remove_edges(patch, quality_of_deg(kGoodDeg));
      flatten_interfaces(patch, goal_);
      optimize_worst_angles(patch, goal_);
    });
    sizes_.clear();
    longest_on_interface_mm_ = {};
  }

  [[nodiscard]] bool is_fixed(VertexId v) const { return v < fixed_.size() && fixed_[v] != 0; }

  /// Edges at fixed vertices may be longer than those that these have among themselves.
  void allow_edges_at_fixed_vertices() {
    for (std::size_t t = 0; !fixed_.empty() && t < mesh_.tets.size(); ++t) {
      for (const VertexId v : mesh_.tets[t]) {
        for (const VertexId w : mesh_.tets[t]) {
          if (is_fixed(v) && is_fixed(w)) {
            const double edge_mm = (mesh_.points[v] - mesh_.points[w]).norm();
            sizes_[v] = std::max(sizes_[v], kGrowthAtFixed * edge_mm);
          }
        }
      }
    }
  }

  /// Of the edges that surfaces have, so that the inside becomes finer with them.
  [[nodiscard]] double longest_inner_mm() const {
    return tolerances::kLargestInner *
           (mm_.surface_edge > 0 ? mm_.surface_edge / tolerances::kEdgesPerReach : mm_.reach);
  }

  [[nodiscard]] double longest_on_surface_mm() const {
    return mm_.surface_edge > 0 ? kLongestPerMean * mm_.surface_edge
                                : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] double collapse_deg() const {
    return std::max(options_.min_dihedral_deg - options_.collapse_leeway_deg,
                    0.5 * options_.min_dihedral_deg);
  }

  /// The offsets that the last round's volumes ask for take effect in further relaxations.
  void settle_volumes() {
    for (int i = 0; i < kSettlings && (i == 0 || largest_lack() > kLargestLack); ++i) {
      in_patches("settling", [this](Patch& patch) {
        relax_vertices(patch, relax_);
        relax_vertices(patch, relax_);
      });
    }
  }

  void repair_angles() {
    for (int i = 0; i < options_.repair_rounds && repair("repair", goal_, i) > 0; ++i) {
    }
  }

  /// Self-intersections, far vertices and volumes. Where tets have been relabelled, bad ones may move that
  /// were stuck before. What still intersects after that may cost a little more distance, and what is left is
  /// searched for a change place by place.
  void finish_surfaces() {
    with_cover(cover_.reach_mm, [this](SurfaceCover& cover) { separate_and_relabel(cover); });
    for (int i = 0;
         report_.tets_relabelled > 0 && i < kLastRepairs && repair("repair", goal_, kFarRepair + i) > 0;
         ++i) {
    }
    for (int i = 0; i < kCorrections && (i == 0 || largest_lack() > kLargestLack); ++i) {
      correct_and_separate();
    }
    if (options_.may_relabel && !options_.keep_distances && has_surface_defects()) {
      clock_.time("surface_defects", [this] { remove_defects(); });
    }
  }

  void finish() {
    report_.uncovered_samples =
        static_cast<std::size_t>(std::count(cover_.covering.begin(), cover_.covering.end(), kNoVertex));
    report_.rounds = round_;
    report_.tets_after = mesh_.tets.size();
    report_.min_dihedral_after_deg = degrees(worst_sine_squared(mesh_));
    if (!options_.only_bad && options_.may_relabel) {
      clock_.time("check", [this] {
        report_.self_intersections_left =
            std::max(report_.self_intersections_left, count_self_intersections(mesh_, domain_.label_of()));
      });
    }
  }

  // ---- Their parts

  /// Repairs the tets worse than `below` and those around them; returns how many there are. They are rare and
  /// stuck: from round to round more tets around them may move, edges may be split, and, unless the distances
  /// are to be kept, reach and deviation grow a little.
  std::size_t repair(const std::string& name, double below, int round) {
    PatchRules rules = rules_now();
    if (!options_.keep_distances) {
      const double more_mm = tolerances::kRepairStep * round * mm_.scale;
      rules.reach_mm =
          std::max(rules.reach_mm, std::min(tolerances::kRepairReach * mm_.scale, rules.reach_mm + more_mm));
      double& deviation_mm = rules.guards.deviation_mm;
      deviation_mm =
          std::max(deviation_mm, std::min(tolerances::kRepairDeviation * mm_.scale, deviation_mm + more_mm));
    }
    if (round >= kFarRepair) {
      release_fixed_vertices(below);
    }
    on_round_(round_);
    std::size_t bad = 0;
    clock_.time(name, [&] {
      bad = improve_near_bad_tets(mesh_, cover_.covering, rules, round_++, below, std::min(4, round + 1),
                                  [&](Patch& patch) { repair_patch(patch, below > 0 ? round : 0); });
    });
    return bad;
  }

  /// Fixed vertices of tets that are still bad may move from now on.
  void release_fixed_vertices(double below) {
    for (std::size_t t = 0; !fixed_.empty() && t < mesh_.tets.size(); ++t) {
      const auto& n = mesh_.tets[t];
      const auto& p = mesh_.points;
      const bool any = std::any_of(n.begin(), n.end(), [this](VertexId v) { return is_fixed(v); });
      if (any && tet_quality(p[n[0]], p[n[1]], p[n[2]], p[n[3]]) < below) {
        for (const VertexId v : n) {
          if (v < fixed_.size()) {
            fixed_[v] = 0;
          }
        }
      }
    }
  }

  /// From the second round on edges may be split; later the vertices are relaxed with less weight of the
  /// surface first.
  void repair_patch(Patch& patch, int round) const {
    for (int turn = 0; turn < 3; ++turn) {
      if (round >= kFarRepair && turn == 1) {
        RelaxOptions loose = relax_;
        loose.surface_weight *= 0.03;
        relax_vertices(patch, loose);
      }
      optimize_worst_angles(patch, goal_);
      remove_edges(patch, goal_);
      collapse_edges(patch, {.threshold_quality = goal_, .longest_growth = kLongestGrowth, .only_bad = true});
      if (round > 0 && turn == 1) {
        split_edges(patch, goal_);
      }
    }
    optimize_worst_angles(patch, goal_);
  }

  /// Surfaces that the volume correction moves may meet, and what is separated is missing from the volumes.
  void correct_and_separate() {
    if (options_.correct_volumes) {
      with_cover(cover_.reach_mm,
                 [this](SurfaceCover& cover) { clock_.time("volumes", [&] { correct(cover); }); });
    }
    const double farthest_mm = std::max(cover_.reach_mm, tolerances::kRepairReach * mm_.scale);
    with_cover(options_.keep_distances ? cover_.reach_mm : farthest_mm,
               [this](SurfaceCover& cover) { separate_and_relabel(cover); });
  }

  void correct(const SurfaceCover& cover) {
    VolumeCorrectionOptions options;
    options.wanted_mm3 = domain_.volumes_mm3();
    options.label_of = domain_.label_of();
    options.step_mm = tolerances::kVolumeStep * mm_.scale;
    options.goal_quality = goal_;
    correct_volumes(mesh_, cover, options);
  }

  /// Of a material's volume, the largest share that is missing or in excess; small volumes do not count.
  [[nodiscard]] double largest_lack() const {
    return options_.correct_volumes
               ? largest_volume_error(mesh_, domain_, kSmallVolumes * largest_change_mm3())
               : 0;
  }

  /// Intersecting facets are separated; where that fails, and at far vertices and pinches, tets are
  /// relabelled.
  void separate_and_relabel(SurfaceCover& cover) {
    clock_.time("self_intersections", [&] { separate_and_relabel_in_turns(cover); });
  }

  void separate_and_relabel_in_turns(SurfaceCover& cover) {
    const SeparationOptions separation{
        .step_mm = tolerances::kSeparationStep * mm_.scale, .goal_quality = goal_, .rounds = 12};
    const RelabelOptions relabel{.step_mm = cover_.reach_mm,
                                 .largest_mm3 = largest_change_mm3(),
                                 .goal_quality = goal_,
                                 .rounds = 6,
                                 .keep_topology = options_.keep_topology};
    for (int turn = 0; turn < 3; ++turn) {
      report_.self_intersections_left = separate_self_intersections(mesh_, cover, separation);
      if (!options_.may_relabel) {
        return;
      }
      const RelabelReport report = relabel_misplaced_tets(mesh_, cover, domain_, relabel);
      report_.tets_relabelled += report.tets_relabelled;
      may_have_defects_ = report.defects_left > 0;
      if (report.tets_relabelled + report.vertices_moved == 0) {
        return;
      }
    }
    may_have_defects_ = true;
    report_.self_intersections_left = separate_self_intersections(mesh_, cover, separation);
  }

  [[nodiscard]] bool has_surface_defects() const {
    return may_have_defects_ || has_far_samples(mesh_, cover_, far_limit_mm()) ||
           count_self_intersections(mesh_, domain_.label_of()) > 0;
  }

  [[nodiscard]] double far_limit_mm() const {
    return tolerances::kFarLimit * std::max(mm_.scale, mm_.reach / tolerances::kReach);
  }

  void remove_defects() {
    DefectRemovalOptions options;
    options.limit_mm = far_limit_mm();
    options.step_mm = mm_.scale;
    options.largest_mm3 = largest_change_mm3();
    options.goal_quality = goal_;
    options.keep_topology = options_.keep_topology;
    options.fixed = fixed_;
    const DefectRemovalReport report = remove_surface_defects(mesh_, domain_, options);
    report_.tets_relabelled += report.tets_relabelled;
    report_.self_intersections_left = report.self_intersections_left;
    report_.surface_defects_left = report.defects_left;
  }

  [[nodiscard]] double largest_change_mm3() const { return kLargestCells * domain_.cell_mm3(); }

  // ---- Steps over the whole mesh

  /// Calls a step with the cover of the whole mesh, and keeps what it reassigns.
  template <typename Step>
  void with_cover(double reach_mm, const Step& step) {
    SurfaceCover cover(cover_.samples, cover_.covering, mesh_.points.size(), reach_mm);
    step(cover);
    for (VertexId v = 0; v < mesh_.points.size(); ++v) {
      cover.for_each(v, [&](SampleId s) { cover_.covering[s] = v; });
    }
  }

  [[nodiscard]] PatchRules rules_now() const {
    return {.boundaries = {.domain = domain_, .offset_mm = offsets_.offset_mm()},
            .guards = {.deviation_mm = mm_.deviation, .scale_mm = mm_.scale},
            .samples = cover_.samples,
            .reach_mm = cover_.reach_mm,
            .own_reach_mm = cover_.own_reach_mm,
            .fixed = fixed_,
            .longest_mm = sizes_,
            .longest_on_interface_mm = longest_on_interface_mm_,
            .smoothness_cap_mm = caps_};
  }

  template <typename Improve>
  void in_patches(const std::string& name, const Improve& improve) {
    on_round_(round_);
    clock_.time(name, [&] { improve_in_patches(mesh_, cover_.covering, rules_now(), round_++, improve); });
    clock_.time("covering", [this] { cover_uncovered_samples(mesh_, cover_); });
    if (options_.correct_volumes) {
      clock_.time("volumes", [this] { offsets_.update(mesh_); });
    }
  }

  MaterialMesh& mesh_;
  const Domain& domain_;
  const ImproveOptions& options_;
  const std::function<void(int)>& on_round_;
  std::vector<std::uint8_t> fixed_;  // vertices that stay; vertices keep their numbers until the end
  double goal_;
  Lengths mm_;
  RelaxOptions relax_;
  std::vector<double> longest_mm_;  // edges of each material
  VolumeOffsets offsets_;
  SampleCover cover_{};
  std::vector<double> caps_;                         // of the smoothness, by material
  std::vector<double> sizes_;                        // in a round of decimation with a gradation
  std::vector<double> thin_edges_mm_;                // the longest ones at vertices on interfaces
  std::span<const double> longest_on_interface_mm_;  // the same in a round of decimation
  double least_share_ = 0;  // of its tets that a patch keeps in a round of decimation
  int round_ = 0;
  bool may_have_defects_ = false;  // the last relabelling has left some
  StageClock clock_;               // of the parts
  ImproveReport report_;
};

}  // namespace

ImproveReport improve_mesh(MaterialMesh& mesh, const Domain& domain, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round,
                           std::span<const std::uint8_t> fixed) {
  return Improver(mesh, domain, options, on_round, fixed).run();
}

}  // namespace cbc3d
