#include "mesher/stages/refine_lattice.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "mesher/improve/image_boundary.hpp"
#include "mesher/stages/check_topology.hpp"
#include "mesher/stages/coverage.hpp"
#include "mesher/stages/red_green.hpp"
#include "mesher/stages/select_candidate.hpp"
#include "mesher/stages/size_rank.hpp"
#include "mesher/stages/voxel_raster.hpp"

namespace cbc3d {
namespace {

class Refiner {
 public:
  Refiner(Lattice& lattice, const LabelImage& image, const RefineOptions& options)
      : lattice_(lattice),
        image_(image),
        options_(options),
        raster_(image.frame, lattice.frame),
        boundary_(image, {}) {
    const std::vector<std::size_t> voxels = image.voxels_per_material();
    rank_ = rank_by_size(image, BackgroundRank::highest);
    for (std::size_t m = 0; m < voxels.size(); ++m) {
      const auto own = options.material_fidelity.find(image.labels[m]);
      result_.fidelity.push_back({static_cast<MaterialId>(m), image.labels[m],
                                  own != options.material_fidelity.end() ? own->second : options.fidelity, 0,
                                  voxels[m], 0});
    }
    if (options.max_distance_mm > 0 && options.each_interface) {
      interfaces_.emplace(image);
    } else if (options.max_distance_mm > 0) {
      coverage_.emplace(image);
    }
  }

  RefineResult run(const std::function<void(int, std::size_t)>& on_round) {
    for (result_.rounds = 1;; ++result_.rounds) {
      label_by_centroid();
      select();
      find_uncovered_voxels();
      measure_fidelity();
      mark_strays();
      mark_oversized();
      on_round(result_.rounds, result_.mesh.tets.size());
      if (mark() == 0 || result_.rounds == options_.max_rounds || exceeds_budget()) {
        break;
      }
      refine_red_green(lattice_, marked_);
    }
    finish();
    return std::move(result_);
  }

 private:
  /// The material of a tet is that of the image at its centroid: the one whose signed distance is positive
  /// there.
  void label_by_centroid() {
    CandidateMesh& mesh = result_.mesh;
    mesh.tets = extract_tets(lattice_);
    points_ = local_points(lattice_);
    mesh.materials.resize(mesh.tets.size());
    centroid_material_.resize(mesh.tets.size());
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Vec3 centroid;
      for (const VertexId v : mesh.tets.nodes[t]) {
        centroid += 0.25 * points_[v];
      }
      centroid_material_[t] =
          options_.smooth_labels ? boundary_.material_at(centroid) : image_.at_local(centroid);
    }
    mesh.materials = centroid_material_;
  }

  void select() {
    CandidateMesh& mesh = result_.mesh;
    mesh.neighbours = tet_neighbours(mesh.tets.nodes, points_.size());
    if (options_.one_face_rule) {
      select_candidate(mesh.neighbours, rank_, mesh.materials);
    }
  }

  void find_uncovered_voxels() {
    if (interfaces_) {
      const CandidateMesh& mesh = result_.mesh;
      sets_ = vertex_materials(mesh.tets.nodes, mesh.materials, mesh.neighbours, points_.size());
      interfaces_->update(sets_, points_, options_.max_distance_mm);
    }
    if (coverage_) {
      const CandidateMesh& mesh = result_.mesh;
      coverage_->update(surface_vertices(mesh.tets.nodes, mesh.neighbours, mesh.materials), points_,
                        options_.max_distance_mm);
    }
  }

  [[nodiscard]] std::array<LatticePoint, 4> lattice_points(std::size_t t) const {
    const auto& nodes = result_.mesh.tets.nodes[t];
    return {lattice_.points[nodes[0]], lattice_.points[nodes[1]], lattice_.points[nodes[2]],
            lattice_.points[nodes[3]]};
  }

  /// |S1| and |S1 n S2| of every material by exact voxel-in-tet counting; on the way, the red tets that hold
  /// an uncovered boundary voxel.
  void measure_fidelity() {
    const CandidateMesh& mesh = result_.mesh;
    marked_.assign(lattice_.reds.size(), 0);
    for (MaterialFidelity& f : result_.fidelity) {
      f.mesh_voxels = f.common_voxels = 0;
    }
#pragma omp parallel
    {
      std::vector<std::size_t> inside(result_.fidelity.size(), 0);
      std::vector<std::size_t> common(result_.fidelity.size(), 0);
#pragma omp for schedule(dynamic, 512) nowait
      for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
        count_tet(t, inside[mesh.materials[t]], common[mesh.materials[t]]);
      }
#pragma omp critical(cbc3d_measure_fidelity)
      for (std::size_t m = 0; m < inside.size(); ++m) {
        result_.fidelity[m].mesh_voxels += inside[m];
        result_.fidelity[m].common_voxels += common[m];
      }
    }
  }

  void count_tet(std::size_t t, std::size_t& inside, std::size_t& common) {
    const MaterialId own = result_.mesh.materials[t];
    bool uncovered = false;
    raster_.for_each_row(lattice_points(t), [&](int j, int k, int i_begin, int i_end) {
      inside += static_cast<std::size_t>(i_end - i_begin);
      common += image_.voxels.visit([&](const auto* voxels) {
        const auto* row = voxels + image_.frame.offset(0, j, k);
        return static_cast<std::size_t>(std::count(row + i_begin, row + i_end, own));
      });
      uncovered = uncovered || (coverage_ && coverage_->wants_refinement(j, k, i_begin, i_end)) ||
                  (interfaces_ && interfaces_->wants_refinement(j, k, i_begin, i_end));
    });
    if (uncovered) {
      mark_tet(t);
    }
  }

  void mark_tet(std::size_t t) {
    // Pieces of one red tet may be marked by several threads; they write the same value.
    std::atomic_ref<std::uint8_t>(marked_[result_.mesh.tets.parent[t]]).store(1, std::memory_order_relaxed);
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
      mark_what_repair_loses();
    }
    return count_splittable();
  }

  /// What is to be kept is the mesh after the repair of its topology, so that is judged as well: where the
  /// repair takes a boundary voxel's interface away, a finer lattice keeps it.
  void mark_what_repair_loses() {
    check_topology(result_.mesh, points_, image_,
                   {true, options_.one_face_rule, options_.repair_image_passes, 0.0});
    find_uncovered_voxels();
    measure_fidelity();
    mark_strays();
  }

  /// Noise asks for the finest lattice everywhere; what a real image needs is 6 to 15 tets a point, and more
  /// where specks of a voxel are many.
  bool exceeds_budget() {
    constexpr std::size_t kTetsPerPoint = 40;
    constexpr std::size_t kTets = 250000;
    const std::size_t tets = result_.mesh.tets.size();
    if (!interfaces_ || tets < kTets + kTetsPerPoint * interfaces_->point_count()) {
      return false;
    }
    result_.warnings.push_back("the refinement ended at " + std::to_string(tets) +
                               " tets, before every interface was near enough: the image looks like noise");
    return true;
  }

  /// Tets of a label that is to have smaller elements.
  void mark_oversized() {
    if (options_.size_mm.empty()) {
      return;
    }
    const std::vector<double> size_mm =
        values_of_materials(image_, options_.size_mm, std::numeric_limits<double>::infinity());
    const std::vector<MaterialId>& materials = result_.mesh.materials;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < materials.size(); ++t) {
      if (lattice_.frame.spacing_mm(level_of(t)) > size_mm[materials[t]]) {
        mark_tet(t);
      }
    }
  }

  /// The other direction: a vertex of an interface that lies too far from where the image has that interface.
  void mark_strays() {
    if (options_.max_stray_mm <= 0 || !interfaces_) {
      return;
    }
    mark_false_contacts();
    const CandidateMesh& mesh = result_.mesh;
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId across = mesh.neighbours[t][n];
        const MaterialId other = across == kNoTet ? kBackground : mesh.materials[across];
        if (mesh.materials[t] > other && strays(t, n, other)) {
          mark_tet(t);
          if (across != kNoTet) {
            mark_tet(across);
          }
        }
      }
    }
  }

  /// Materials that meet at a vertex of the mesh and nowhere near it in the image: the lattice bridges a gap.
  void mark_false_contacts() {
    std::vector<std::uint8_t> bad(points_.size(), 0);
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t v = 0; v < sets_.size(); ++v) {
      bad[v] = sets_[v].size > 2 && !all_meet_near(image_, points_[v], sets_[v], options_.contact_reach_mm)
                   ? 1
                   : 0;
    }
    const TetNodes& nodes = result_.mesh.tets.nodes;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < nodes.size(); ++t) {
      if (std::any_of(nodes[t].begin(), nodes[t].end(),
                      [&](VertexId v) { return !sets_.empty() && bad[v] != 0; })) {
        mark_tet(t);
      }
    }
  }

  [[nodiscard]] bool strays(std::size_t t, std::size_t n, MaterialId other) const {
    const CandidateMesh& mesh = result_.mesh;
    return std::any_of(kTetFace[n].begin(), kTetFace[n].end(), [&](std::uint8_t corner) {
      const Vec3& at = points_[mesh.tets.nodes[t][corner]];
      return boundary_.sample(at, mesh.materials[t], other).deviation_mm > options_.max_stray_mm;
    });
  }

  /// The paper: when the fidelity is settled, the tets around non-manifold vertices and edges are split in
  /// the next round.
  void mark_non_manifold() {
    const CandidateMesh& mesh = result_.mesh;
    std::vector<std::uint8_t> bad(points_.size(), 0);
    for (const VertexId v : non_manifold_vertices(mesh, points_.size(), image_.labels)) {
      bad[v] = 1;
    }
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto& n = mesh.tets.nodes[t];
      if ((bad[n[0]] | bad[n[1]] | bad[n[2]] | bad[n[3]]) != 0 && may_split_for_fidelity(t)) {
        mark_tet(t);
      }
    }
  }

  [[nodiscard]] std::size_t count_splittable() const {
    std::size_t can_split = 0;
    for (std::size_t r = 0; r < marked_.size(); ++r) {
      can_split +=
          static_cast<std::size_t>(marked_[r] != 0 && lattice_.reds[r].level < lattice_.frame.max_level);
    }
    return can_split;
  }

  /// The paper's criterion. The signed distance of material m is positive in its voxels, zero on its boundary
  /// voxels and negative in all others, so "it changes sign between the centroid and a vertex" is "one of the
  /// two lies in a voxel of m and the other does not": a look-up in the image decides it, no distance map is
  /// needed.
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

  /// A structure that passes between the centroids and vertices of coarse tets changes no sign, yet it is
  /// missing. So the tets that hold voxels of an unmet material but are not of it are split as well (the
  /// paper's ancestor did so).
  void mark_misjudged(const std::vector<std::uint8_t>& unmet) {
    const CandidateMesh& mesh = result_.mesh;
#pragma omp parallel for schedule(dynamic, 512)
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (marked_[mesh.tets.parent[t]] != 0 || !may_split_for_fidelity(t)) {
        continue;
      }
      const MaterialId own = mesh.materials[t];
      bool misjudged = false;
      raster_.for_each_row(lattice_points(t), [&](int j, int k, int i_begin, int i_end) {
        misjudged = misjudged || image_.voxels.visit([&](const auto* voxels) {
          const auto* row = voxels + image_.frame.offset(0, j, k);
          return std::any_of(row + i_begin, row + i_end,
                             [&](MaterialId m) { return m != own && (unmet[m] != 0 || unmet[own] != 0); });
        });
      });
      if (misjudged) {
        mark_tet(t);
      }
    }
  }

  void finish() {
    result_.uncovered_voxels = coverage_ ? coverage_->uncovered_count() : 0;
    result_.uncovered_voxels += interfaces_ ? interfaces_->uncovered_count() : 0;
    result_.fidelity.erase(result_.fidelity.begin());  // background
    char text[256];
    for (const MaterialFidelity& f : result_.fidelity) {
      if (!f.met()) {
        std::snprintf(text, sizeof(text),
                      "label %d: fidelity %.3f not met (F1 = %.4f, F2 = %.4f): the lattice may not be finer "
                      "than %.3g mm",
                      f.label, f.wanted, f.f1(), f.f2(), options_.finest_spacing_mm);
        result_.warnings.emplace_back(text);
      }
    }
    if (result_.uncovered_voxels > 0) {
      std::snprintf(
          text, sizeof(text),
          "%zu boundary voxels lie farther than %.3g mm from the interface at the finest spacing %.3g mm",
          result_.uncovered_voxels, options_.max_distance_mm,
          lattice_.frame.spacing_mm(lattice_.frame.max_level));
      result_.warnings.emplace_back(text);
    }
  }

  Lattice& lattice_;
  const LabelImage& image_;
  const RefineOptions& options_;
  VoxelRaster raster_;
  ImageBoundary boundary_;
  std::optional<BoundaryCoverage> coverage_;
  std::optional<InterfaceCoverage> interfaces_;
  std::vector<MaterialSet> sets_;  // of interfaces_' last update
  std::vector<std::uint32_t> rank_;
  std::vector<Vec3> points_;
  std::vector<MaterialId> centroid_material_;
  std::vector<std::uint8_t> marked_;
  int topology_rounds_ = 0;
  int repairs_ = 0;
  RefineResult result_;
};

}  // namespace

RefineResult refine_lattice(Lattice& lattice, const LabelImage& image, const RefineOptions& options,
                            const std::function<void(int round, std::size_t tets)>& on_round) {
  return Refiner(lattice, image, options).run(on_round);
}

}  // namespace cbc3d
