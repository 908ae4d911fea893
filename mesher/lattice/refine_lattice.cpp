#include "mesher/lattice/refine_lattice.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mesher/domain/coverage.hpp"
#include "mesher/domain/size_rank.hpp"
#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/exact_voxels.hpp"
#include "mesher/lattice/fidelity_account.hpp"
#include "mesher/lattice/label_betti.hpp"
#include "mesher/lattice/lattice_places.hpp"
#include "mesher/lattice/part_raster.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/select_candidate.hpp"
#include "mesher/lattice/voxel_raster.hpp"

namespace cbc3d {
namespace {

class Refiner {
 public:
  Refiner(Lattice& lattice, const ImageDomain& domain, const RefineOptions& options)
      : lattice_(lattice),
        domain_(domain),
        image_(domain.image()),
        options_(options),
        raster_(image_.frame, lattice.frame),
        account_(image_, raster_, domain.voxels().count),
        red_green_(lattice),
        follower_(lattice),
        rank_(rank_by_size(domain.voxels(), BackgroundRank::highest)) {
    result_.fidelity =
        wanted_fidelity(image_.labels, domain.voxels().count, options.fidelity, options.material_fidelity);
    if (options.max_distance_mm > 0 && options.each_interface) {
      interfaces_.emplace(domain);
    } else if (options.max_distance_mm > 0) {
      coverage_.emplace(image_);
    }
    if (interfaces_ || coverage_) {
      places_.emplace(image_.frame, lattice.frame);
    }
    if (options.keep_topology) {
      parts_.emplace(image_, lattice.frame);
      betti_of_image_.emplace(image_);
    }
  }

  RefineResult run(const std::function<void(int, std::size_t)>& on_round) {
    for (result_.rounds = 1;; ++result_.rounds) {
      follow_lattice();
      label_by_centroid();
      judge();
      mark_oversized();
      on_round(result_.rounds, result_.mesh.tets.size());
      if (mark() == 0 || result_.rounds == options_.max_rounds || exceeds_budget()) {
        break;
      }
      red_green_.refine(marked_);
    }
    finish();
    return std::move(result_);
  }

 private:
  /// Brings the mesh up to the lattice, and what is known of its tets to their new numbers.
  void follow_lattice() {
    CandidateMesh& mesh = result_.mesh;
    const UninitializedVector<TetId> number = follower_.renumber();
    forget_removed(number);
    follower_.rebuild(mesh, number);
    judged_ = renumbered(judged_, number, mesh.tets.size(), kNotJudged);
    centroid_material_ = renumbered(centroid_material_, number, mesh.tets.size(), kBackground);
    foreign_ = renumbered(foreign_, number, mesh.tets.size(), ForeignMaterials{0});
    append_local_points(lattice_, points_);
    touched_.resize(points_.size(), 1);
    mesh.unsure.resize(points_.size(), 1);
    far_verdict_.resize(points_.size(), 0);
  }

  /// Takes the tets that are gone out of the account.
  void forget_removed(const UninitializedVector<TetId>& number) {
    touched_.assign(points_.size(), 0);
    tally(number.size(), [&](std::size_t t, FidelityAccount::Changes& changes) {
      if (number[t] == kNoTet) {
        touch_nodes(t);
        leave_account(t, changes);
      }
    });
  }

  [[nodiscard]] Vec3 centroid_of(std::size_t t) const {
    Vec3 centroid;
    for (const VertexId v : result_.mesh.tets.nodes[t]) {
      centroid += 0.25 * points_[v];
    }
    return centroid;
  }

  /// The material of a tet is that of the image at its centroid: the one whose signed distance is positive
  /// there.
  void label_by_centroid() {
    CandidateMesh& mesh = result_.mesh;
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (judged_[t] == kNotJudged) {
        centroid_material_[t] = material_at(centroid_of(t));
      }
    }
    mesh.materials.assign(centroid_material_.begin(), centroid_material_.end());
    if (options_.one_face_rule) {
      select_candidate(mesh.neighbours, rank_, mesh.materials);
    }
  }

  [[nodiscard]] MaterialId material_at(const Vec3& x) const {
    return options_.smooth_labels && !(exact_ && exact_->holds(x)) ? domain_.material_at(x)
                                                                   : image_.at_local(x);
  }

  /// True while what is known of the tet is of another material than it has now, or nothing.
  [[nodiscard]] bool is_changed(std::size_t t) const {
    return judged_[t] != result_.mesh.materials[t];
  }

  /// Judges the mesh by its materials and marks what is to be split. What depends on unchanged tets alone is
  /// not computed again: of those, what is marked and can be split has been.
  void judge() {
    marked_.assign(lattice_.reds.size(), 0);
    touch_changed();
    find_uncovered_voxels();
    measure_fidelity();
    mark_uncovered();
    mark_far_vertices();
    mark_lost_thin_voxels();
    const std::vector<MaterialId>& materials = result_.mesh.materials;
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      judged_[t] = materials[t];
    }
    std::fill(touched_.begin(), touched_.end(), 0);
  }

  void touch_changed() {
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      if (is_changed(t)) {
        touch_nodes(t);
      }
    }
    std::vector<std::uint8_t>& unsure = result_.mesh.unsure;
    for (std::size_t v = 0; v < touched_.size(); ++v) {
      unsure[v] |= touched_[v];
    }
  }

  void touch_nodes(std::size_t t) {
    for (const VertexId v : result_.mesh.tets.nodes[t]) {
      set_flag(touched_[v]);
    }
  }

  /// Several threads may set the same flag; they write the same value.
  static void set_flag(std::uint8_t& flag) {
    std::atomic_ref<std::uint8_t>(flag).store(1, std::memory_order_relaxed);
  }

  void find_uncovered_voxels() {
    const CandidateMesh& mesh = result_.mesh;
    if (interfaces_) {
      sets_.resize(points_.size());
      renew_vertex_materials(mesh.tets.nodes, mesh.materials, mesh.neighbours, touched_, sets_);
      interfaces_->update(sets_, points_, options_.max_distance_mm);
    }
    if (coverage_) {
      coverage_->update(surface_vertices(mesh.tets.nodes, mesh.neighbours, mesh.materials), points_,
                        options_.max_distance_mm);
    }
  }

  [[nodiscard]] std::array<LatticePoint, 4> lattice_points(std::size_t t) const {
    const auto& nodes = result_.mesh.tets.nodes[t];
    return {lattice_.points[nodes[0]], lattice_.points[nodes[1]], lattice_.points[nodes[2]],
            lattice_.points[nodes[3]]};
  }

  /// Adds up what visit(t, changes) finds for t = 0 ... tets - 1, in parallel.
  template <typename Visit>
  void tally(std::size_t tets, const Visit& visit) {
#pragma omp parallel
    {
      FidelityAccount::Changes changes = account_.no_changes();
#pragma omp for schedule(dynamic, 512) nowait
      for (std::size_t t = 0; t < tets; ++t) {
        visit(t, changes);
      }
#pragma omp critical(cbc3d_tally)
      account_.add(changes);
    }
  }

  /// |S1| and |S1 n S2| of every material, by exact voxel-in-tet counting of the tets that have changed.
  void measure_fidelity() {
    tally(judged_.size(), [&](std::size_t t, FidelityAccount::Changes& changes) {
      if (is_changed(t)) {
        leave_account(t, changes);
        foreign_[t] = account_.enter(lattice_points(t), result_.mesh.materials[t], changes);
      }
    });
    for (MaterialFidelity& f : result_.fidelity) {
      f.mesh_voxels = account_.mesh_voxels(f.material);
      f.common_voxels = account_.common_voxels(f.material);
    }
  }

  void leave_account(std::size_t t, FidelityAccount::Changes& changes) {
    if (judged_[t] != kNotJudged && foreign_[t] != 0) {
      account_.leave(lattice_points(t), static_cast<MaterialId>(judged_[t]), changes);
    }
  }

  [[nodiscard]] bool wants_refinement(int j, int k, int i_begin, int i_end) const {
    return (coverage_ && coverage_->wants_refinement(j, k, i_begin, i_end)) ||
           (interfaces_ && interfaces_->wants_refinement(j, k, i_begin, i_end));
  }

  [[nodiscard]] std::size_t uncovered_count() const {
    return (coverage_ ? coverage_->uncovered_count() : 0) +
           (interfaces_ ? interfaces_->uncovered_count() : 0);
  }

  /// Marks tets with an uncovered voxel.
  void mark_uncovered() {
    if (!places_ || uncovered_count() == 0) {
      return;
    }
    LatticePlaces& places = *places_;
    places.clear();
    const auto add = [&](const Vec3& centre) { places.add(centre); };
    if (interfaces_) {
      interfaces_->for_each_wanted(add);
    }
    if (coverage_) {
      coverage_->for_each_wanted(add);
    }
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t r = 0; r < lattice_.reds.size(); ++r) {
      const RedTet& red = lattice_.reds[r];
      if (marked_[r] == 0 && places.may_hold(lattice_.points[red.nodes[0]], red.level)) {
        marked_[r] = holds_uncovered(r) ? 1 : 0;
      }
    }
  }

  [[nodiscard]] bool holds_uncovered(std::size_t r) const {
    bool uncovered = false;
    for (TetId t = follower_.first(r); t < follower_.first(r + 1) && !uncovered; ++t) {
      raster_.for_each_row(lattice_points(t), [&](int j, int k, int i_begin, int i_end) {
        uncovered = wants_refinement(j, k, i_begin, i_end);
        return uncovered;
      });
    }
    return uncovered;
  }

  /// Where a part is one voxel thick, a voxel that is lost to another material is a tunnel, a cut or a
  /// cavity: the lattice is refined until each of these voxels' centres is in a tet of its own material.
  void mark_lost_thin_voxels() {
    if (!options_.keep_thin_parts) {
      return;
    }
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      if (is_changed(t) && foreign_[t] != 0 && holds_lost_thin_voxel(t)) {
        mark_tet(t);
      }
    }
  }

  [[nodiscard]] bool holds_lost_thin_voxel(std::size_t t) const {
    const MaterialId own = result_.mesh.materials[t];
    bool lost = false;
    raster_.for_each_row(lattice_points(t), [&](int j, int k, int i_begin, int i_end) {
      for (int i = i_begin; i < i_end && !lost; ++i) {
        lost = image_.at(i, j, k) != own && domain_.is_thin_voxel({i, j, k});
      }
      return lost;
    });
    return lost;
  }

  void mark_tet(std::size_t t) {
    set_flag(marked_[result_.mesh.tets.parent[t]]);
  }

  [[nodiscard]] int level_of(std::size_t t) const {
    return lattice_.reds[result_.mesh.tets.parent[t]].level;
  }
  [[nodiscard]] bool may_split_for_fidelity(std::size_t t) const {
    return level_of(t) < lattice_.frame.max_level &&
           lattice_.frame.spacing_mm(level_of(t) + 1) >= options_.finest_spacing_mm * (1 - 1e-9);
  }

  /// Marks what is to be split in this round; returns the number of red tets that can be.
  std::size_t mark() {
    std::vector<std::uint8_t> unmet(result_.fidelity.size(), 0);
    bool any = false;
    for (std::size_t m = 1; m < unmet.size(); ++m) {
      unmet[m] = static_cast<std::uint8_t>(!result_.fidelity[m].met());
      any = any || unmet[m] != 0;
    }
    if (any) {
      mark_by_distance_sign(unmet);
      mark_misjudged(unmet);
    }
    if (count_splittable() == 0 && options_.topology_checks && topology_rounds_ < options_.topology_rounds) {
      ++topology_rounds_;
      mark_non_manifold();
    }
    if (count_splittable() == 0 && options_.max_distance_mm > 0 && options_.topology_checks &&
        repairs_ < options_.repair_rounds) {
      ++repairs_;
      mark_what_repair_loses(false);
      const std::size_t lost = count_splittable();
      return lost > 0 ? lost : mark_topology_differences();
    }
    return count_splittable();
  }

  /// The repaired mesh is what is kept, so it is judged as well: a finer lattice keeps what a repair takes
  /// away.
  void mark_what_repair_loses(bool drop_crumbs) {
    repair_topology(result_.mesh, points_, domain_,
                    {.enabled = true,
                     .one_face_rule = options_.one_face_rule,
                     .image_passes = options_.repair_image_passes,
                     .drop_crumbs = drop_crumbs,
                     .small_component = 0});
    judge();
  }

  /// Where a label of the repaired mesh has another topology than in the image, voxels are taken as they are
  /// on a finer lattice. Returns how many tets are to be split or labelled anew.
  std::size_t mark_topology_differences() {
    if (!options_.keep_topology || !betti_of_image_ || !parts_ ||
        betti_of_image_->unlike_labels(result_.mesh, points_).empty()) {
      return 0;
    }
    const ImageBetti& of_image = *betti_of_image_;
    mark_what_repair_loses(true);
    const TopologyDifferences found = find_topology_differences(
        image_, lattice_, result_.mesh, of_image.unlike_labels(result_.mesh, points_));
    ExactVoxels& exact = exact_ ? *exact_ : exact_.emplace(image_.frame);
    exact.add(found.places, found.misplaced);
    std::size_t changed = 0;
#pragma omp parallel for schedule(dynamic, 1024) reduction(+ : changed)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      changed += take_voxels(t) ? 1 : 0;
    }
    return changed + count_splittable();
  }

  /// True when the tet is in an exact voxel and is labelled anew, or holds a part of another label and is
  /// split.
  bool take_voxels(std::size_t t) {
    const Vec3 centroid = centroid_of(t);
    if (!exact_ || !parts_ || !exact_->holds(centroid)) {
      return false;
    }
    const MaterialId now = image_.at_local(centroid);
    const MaterialId before = std::exchange(centroid_material_[t], now);
    const bool is_split = level_of(t) < lattice_.frame.max_level &&
                          (exact_->is_stubborn(centroid) || parts_->holds_other(lattice_points(t), now));
    if (is_split) {
      mark_tet(t);
    }
    return is_split || before != now;
  }

  /// Noise asks for the finest lattice everywhere. A real image needs 6 to 15 tets for each boundary sample,
  /// a field of wires one voxel thick needs 110.
  bool exceeds_budget() {
    constexpr std::size_t kTetsPerSample = 150;
    constexpr std::size_t kTets = 250000;
    const std::size_t tets = result_.mesh.tets.size();
    if (!interfaces_ || tets < kTets + kTetsPerSample * interfaces_->sample_count()) {
      return false;
    }
    result_.warnings.push_back("the refinement ended at " + std::to_string(tets) +
                               " tets, before every interface was near enough: the image looks like noise");
    return true;
  }

  /// Tets of a label, or at interfaces, that are to be smaller.
  void mark_oversized() {
    if (options_.size_mm.empty() && options_.coarsest_spacing_mm <= 0 && options_.interface_spacing_mm <= 0) {
      return;
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto limit = [](double spacing_mm) { return spacing_mm > 0 ? spacing_mm : kInfinity; };
    std::vector<double> size_mm =
        values_of_materials(image_.labels, options_.size_mm, limit(options_.coarsest_spacing_mm));
    size_mm[kBackground] = options_.size_mm.contains(0) ? size_mm[kBackground] : kInfinity;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      const double spacing_mm = lattice_.frame.spacing_mm(level_of(t));
      if (spacing_mm > size_mm[result_.mesh.materials[t]] ||
          (spacing_mm > limit(options_.interface_spacing_mm) && result_.mesh.is_at_interface(t))) {
        mark_tet(t);
      }
    }
  }

  /// The other direction: marks the tets at vertices of an interface that lie too far from where the image
  /// has it.
  void mark_far_vertices() {
    if (options_.max_vertex_distance_mm <= 0 || !interfaces_) {
      return;
    }
    mark_false_contacts();
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t t = 0; t < judged_.size(); ++t) {
      for (std::size_t n = 0; n < 4 && is_changed(t); ++n) {
        mark_if_far(t, n);
      }
    }
  }

  void mark_if_far(std::size_t t, std::size_t n) {
    const CandidateMesh& mesh = result_.mesh;
    const TetId across = mesh.neighbours[t][n];
    const MaterialId own = mesh.materials[t];
    const MaterialId other = across == kNoTet ? kBackground : mesh.materials[across];
    if (own == other || (own < other && is_changed(across))) {  // the latter is the other tet's turn
      return;
    }
    const bool is_far = std::any_of(kTetFace[n].begin(), kTetFace[n].end(), [&](std::uint8_t corner) {
      return is_far_vertex(mesh.tets.nodes[t][corner], std::max(own, other), std::min(own, other));
    });
    if (is_far) {
      mark_tet(t);
      if (across != kNoTet) {
        mark_tet(across);
      }
    }
  }

  /// The last verdict on a vertex is kept with the materials it is about (a > b, so 0 is none): the faces
  /// around the vertex ask the same again. Whatever thread writes it, it is a function of place and
  /// materials.
  bool is_far_vertex(VertexId v, MaterialId a, MaterialId b) {
    const std::uint64_t question = (std::uint64_t{a} << 16U | b) << 1U;
    std::atomic_ref<std::uint64_t> kept(far_verdict_[v]);
    const std::uint64_t known = kept.load(std::memory_order_relaxed);
    if ((known & ~std::uint64_t{1}) == question) {
      return (known & 1U) != 0;
    }
    const bool is_far =
        domain_.boundary_distance(points_[v], a, b).deviation_mm > options_.max_vertex_distance_mm;
    kept.store(question | (is_far ? 1U : 0U), std::memory_order_relaxed);
    return is_far;
  }

  /// Materials that meet at a vertex of the mesh and nowhere near it in the image: the lattice bridges a gap.
  void mark_false_contacts() {
    std::vector<std::uint8_t> bad(points_.size(), 0);
    bool any = false;
#pragma omp parallel for schedule(dynamic, 1024) reduction(|| : any)
    for (std::size_t v = 0; v < sets_.size(); ++v) {
      if (touched_[v] != 0 && sets_[v].size > 2 &&
          !domain_.all_meet_near(points_[v], sets_[v], options_.contact_distance_mm)) {
        bad[v] = 1;
        any = true;
      }
    }
    if (any) {
      mark_tets_at(bad, [](std::size_t) { return true; });
    }
  }

  /// Marks the tets at flagged vertices, of those that may be split.
  template <typename MaySplit>
  void mark_tets_at(const std::vector<std::uint8_t>& flagged, const MaySplit& may_split) {
    const TetNodes& nodes = result_.mesh.tets.nodes;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < nodes.size(); ++t) {
      const auto& n = nodes[t];
      if ((flagged[n[0]] | flagged[n[1]] | flagged[n[2]] | flagged[n[3]]) != 0 && may_split(t)) {
        mark_tet(t);
      }
    }
  }

  /// The paper: when the fidelity is settled, the tets around non-manifold vertices and edges are split in
  /// the next round.
  void mark_non_manifold() {
    std::vector<std::uint8_t> bad(points_.size(), 0);
    for (const VertexId v : non_manifold_vertices(result_.mesh, points_.size(), image_.labels)) {
      bad[v] = 1;
    }
    mark_tets_at(bad, [this](std::size_t t) { return may_split_for_fidelity(t); });
  }

  [[nodiscard]] std::size_t count_splittable() const {
    std::size_t can_split = 0;
    for (std::size_t r = 0; r < marked_.size(); ++r) {
      can_split +=
          static_cast<std::size_t>(marked_[r] != 0 && lattice_.reds[r].level < lattice_.frame.max_level);
    }
    return can_split;
  }

  /// The paper's criterion: "the signed distance of m changes sign between the centroid and a vertex" is "one
  /// of the two lies in a voxel of m and the other does not". A look-up decides it, without a distance map.
  void mark_by_distance_sign(const std::vector<std::uint8_t>& unmet) {
    std::vector<MaterialId> at_vertex(points_.size());
#pragma omp parallel for schedule(static, 4096)
    for (std::size_t v = 0; v < points_.size(); ++v) {
      at_vertex[v] = image_.at_local(points_[v]);
    }
    const LatticeTets& tets = result_.mesh.tets;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < tets.size(); ++t) {
      const MaterialId here = centroid_material_[t];
      for (const VertexId v : tets.nodes[t]) {
        if (at_vertex[v] != here && (unmet[here] != 0 || unmet[at_vertex[v]] != 0) &&
            may_split_for_fidelity(t)) {
          mark_tet(t);
        }
      }
    }
  }

  /// A structure that passes between the centroids and vertices of coarse tets changes no sign. So tets that
  /// hold voxels of an unmet material but are not of it are split too (the paper's ancestor did so).
  void mark_misjudged(const std::vector<std::uint8_t>& unmet) {
    const CandidateMesh& mesh = result_.mesh;
#pragma omp parallel for schedule(dynamic, 512)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (foreign_[t] != 0 && marked_[mesh.tets.parent[t]] == 0 && may_split_for_fidelity(t) &&
          account_.is_misjudged(lattice_points(t), mesh.materials[t], foreign_[t], unmet)) {
        mark_tet(t);
      }
    }
  }

  void finish() {
    result_.uncovered_voxels = uncovered_count();
    result_.fidelity.erase(result_.fidelity.begin());  // background
    const auto unmet = warnings_of_unmet_fidelity(result_.fidelity, options_.finest_spacing_mm);
    result_.warnings.insert(result_.warnings.end(), unmet.begin(), unmet.end());
    if (result_.uncovered_voxels > 0) {
      result_.warnings.push_back(warning_of_uncovered(result_.uncovered_voxels, options_.max_distance_mm,
                                                      lattice_.frame.spacing_mm(lattice_.frame.max_level)));
    }
  }

  Lattice& lattice_;
  const ImageDomain& domain_;
  const LabelImage& image_;  // of the domain
  const RefineOptions& options_;
  VoxelRaster raster_;
  std::optional<PartRaster> parts_;  // with keep_topology
  FidelityAccount account_;
  std::optional<BoundaryCoverage> coverage_;
  std::optional<InterfaceCoverage> interfaces_;
  std::optional<ExactVoxels> exact_;     // none before a difference in topology is found
  std::optional<LatticePlaces> places_;  // of the voxels that interfaces_ or coverage_ wants
  std::vector<MaterialSet> sets_;        // of interfaces_' last update
  RedGreenRefiner red_green_;
  LatticeFollower follower_;
  std::vector<std::uint32_t> rank_;
  static constexpr std::int32_t kNotJudged = -1;
  UninitializedVector<std::int32_t> judged_;       // the material each tet had when it was last judged
  UninitializedVector<ForeignMaterials> foreign_;  // what was in each tet then
  std::vector<std::uint8_t> touched_;              // vertices of tets that changed since
  std::vector<std::uint64_t> far_verdict_;         // of vertices, see is_far_vertex
  std::vector<Vec3> points_;
  UninitializedVector<MaterialId> centroid_material_;
  std::vector<std::uint8_t> marked_;
  int topology_rounds_ = 0;
  int repairs_ = 0;
  std::optional<ImageBetti> betti_of_image_;  // with keep_topology
  RefineResult result_;
};

}  // namespace

RefineResult refine_lattice(Lattice& lattice, const ImageDomain& domain, const RefineOptions& options,
                            const std::function<void(int round, std::size_t tets)>& on_round) {
  return Refiner(lattice, domain, options).run(on_round);
}

}  // namespace cbc3d
