#include "mesher/pipeline/mesh_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "mesher/core/error.hpp"
#include "mesher/domain/tolerances.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/part_raster.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/stage_warnings.hpp"
#include "mesher/pipeline/work_estimate.hpp"

namespace cbc3d {
namespace {

/// Times the stages, announces them, and writes their meshes to files where that is asked for.
class StageLog {
 public:
  StageLog(const LabelImage& image, const MeshImageOptions& options, const Progress& progress,
           MeshImageReport& report)
      : image_(image), options_(options), progress_(progress), report_(report) {}

  template <typename Stage>
  auto run(const std::string& name, double fraction, const Stage& stage) {
    progress_.step(name, fraction);
    return clock_.time(name, stage);
  }

  /// Enters the seconds of all stages into the report.
  void report_seconds() {
    report_.stage_seconds = clock_.seconds();
    report_.seconds = clock_.total_seconds();
    report_.cpu_seconds = clock_.cpu_seconds();
    report_.system_cpu_seconds = clock_.system_cpu_seconds();
  }

  void dump(const std::string& file, const MaterialMesh& mesh) const {
    if (!options_.dump_stages.empty()) {
      std::filesystem::create_directories(options_.dump_stages);
      write_mesh(to_physical_mesh(mesh, image_), options_.dump_stages / (file + ".vtu"));
    }
  }

  [[nodiscard]] bool dumping() const { return !options_.dump_stages.empty(); }

 private:
  const LabelImage& image_;
  const MeshImageOptions& options_;
  const Progress& progress_;
  MeshImageReport& report_;
  StageClock clock_;
};

/// A lattice as a mesh to look at: every tet, labelled 1.
MaterialMesh as_material_mesh(const Lattice& lattice) {
  const LatticeTets tets = extract_tets(lattice);
  return {local_points(lattice), tets.nodes, std::vector<MaterialId>(tets.size(), 1), {}, {}};
}

RefineOptions refine_options(const LabelImage& image, const MeshImageOptions& options) {
  RefineOptions refine = options.refine;
  refine.topology_checks = options.topology.enabled;
  if (refine.finest_spacing_mm <= 0) {
    refine.finest_spacing_mm = default_finest_spacing_mm(image.frame);
  }
  return refine;
}

BccLatticeOptions lattice_options(const LabelImage& image, const MeshImageOptions& options,
                                  MeshImageReport& report) {
  BccLatticeOptions lattice;
  lattice.spacing_mm =
      options.lattice_spacing_mm > 0 ? options.lattice_spacing_mm : default_lattice_spacing_mm(image.frame);
  // A wire one voxel wide needs two halvings below the voxel to be held by several tets; a twelfth of the
  // diagonal is less than that unless voxels are needles or plates.
  const double finest_mm = refine_options(image, options).finest_spacing_mm;
  lattice.finest_spacing_mm =
      options.refine.max_distance_mm > 0
          ? std::max(finest_mm / 4, std::min(finest_mm, image.frame.voxel_diagonal_mm() / 12))
          : finest_mm;
  report.lattice_spacing_mm = lattice.spacing_mm;
  return lattice;
}

std::vector<TopologyPlace> places_of(const LabelImage& image, const std::vector<std::size_t>& offsets) {
  std::vector<TopologyPlace> places;
  for (const std::size_t offset : offsets) {
    const Index3 at = image.frame.index_of(offset);
    places.push_back({image.labels[image.at(at[0], at[1], at[2])],
                      image.frame.to_physical(image.frame.local_centre(at[0], at[1], at[2]))});
  }
  return places;
}

/// Of the candidate mesh with the labels that it is kept with.
void compare_topology(const LabelImage& image, const Lattice& lattice, const CandidateMesh& candidate,
                      MeshImageReport& report) {
  report.topology_differences = label_differences(
      betti_of_labels(image), betti_of_labels(candidate, local_points(lattice), image.labels));
  if (!report.topology_differences.empty()) {
    report.difference_places = places_of(
        image,
        find_topology_differences(image, lattice, candidate, labels_of(report.topology_differences)).places);
  }
}

/// Of the finished mesh: relabelling where surfaces intersect themselves may have changed it. Labels that
/// differ since then have no places.
void compare_topology(const LabelImage& image, const MaterialMesh& mesh, MeshImageReport& report) {
  CandidateMesh finished;
  finished.tets.nodes = mesh.tets;
  finished.materials = mesh.materials;
  finished.neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  report.topology_differences =
      label_differences(betti_of_labels(image), betti_of_labels(finished, mesh.points, image.labels));
  const std::vector<Label> unlike = labels_of(report.topology_differences);
  std::erase_if(report.difference_places, [&](const TopologyPlace& place) {
    return !std::binary_search(unlike.begin(), unlike.end(), place.label);
  });
}

/// Tets that are not background.
std::size_t labelled_tets(const CandidateMesh& mesh) {
  return mesh.materials.size() -
         static_cast<std::size_t>(std::count(mesh.materials.begin(), mesh.materials.end(), kBackground));
}

/// The lengths of refinement and improvement, all by one factor. Below 1 the surfaces have shorter edges and
/// the lattice there is finer, but they may stay as far from the voxels as before: half a voxel is what an
/// image is sure of, and surfaces that had to come nearer would follow its steps.
void scale_lengths(double factor, RefineOptions& refine, ImproveOptions& improve) {
  constexpr double kSpacingPerEdge = 0.75;  // levels halve it, so that the lattice has .4 to .75 of the edges
  const double natural_mm = tolerances::kEdgesPerReach * refine.max_distance_mm;
  if (factor < 1) {
    const double edge_mm = factor * (improve.surface_edge_mm > 0 ? improve.surface_edge_mm : natural_mm);
    improve.reach_mm = refine.max_distance_mm;
    improve.surface_edge_mm = edge_mm;
    refine.interface_spacing_mm = kSpacingPerEdge * edge_mm;
    refine.coarsest_spacing_mm = tolerances::kLargestInner / tolerances::kEdgesPerReach * edge_mm;
  } else {
    refine.max_distance_mm *= factor;
    improve.reach_mm = refine.max_distance_mm;
    improve.deviation_diagonals *= factor;
  }
}

/// The hexes that the improvement works around. They have their places in the lattice, unless a deformation
/// has moved its vertices.
HexCore hex_core_for(const MaterialMesh& mesh, const ImageDomain& domain, const ImproveOptions& improve,
                     const MixOptions& mix) {
  const double reach_mm = improve.reach_mm > 0 ? improve.reach_mm : tolerances::kReach * domain.scale_mm();
  const double natural_mm = tolerances::kEdgesPerReach * reach_mm;
  const double surface_edge_mm = improve.surface_edge_mm > 0 ? improve.surface_edge_mm : natural_mm;
  const double longest_mm = tolerances::kLargestInner * surface_edge_mm / tolerances::kEdgesPerReach;
  const std::vector<double> of_material =
      values_of_materials(domain.labels(), improve.size_mm, std::numeric_limits<double>::infinity());
  return choose_hex_core(mesh,
                         {.surface_edge_mm = surface_edge_mm,
                          .gradation = improve.gradation,
                          .longest_mm = longest_mm,
                          .longest_of_material_mm = of_material},
                         mix);
}

/// Throws InputError beyond the limit, which 0 is not.
void require_work_within_limit(double limit_s, std::size_t tets_of_rounds, std::size_t tets) {
  if (limit_s > 0 && work_of_lattice_s(tets_of_rounds, tets) > limit_s) {
    char text[160];
    std::snprintf(
        text, sizeof(text),
        "the lattice needs %zu tets or more, which foretell more than %.0f s of CPU; if that is meant, a "
        "larger work_limit_s, or 0, lifts the limit",
        tets, limit_s);
    throw InputError(text, "work_limit_s");
  }
}

/// The sections of the method after the cleaning, each a step on what the steps before have left.
class CleanImageMeshing {
 public:
  CleanImageMeshing(const ImageDomain& domain, const MeshImageOptions& options, StageLog& log,
                    const Progress& progress, MeshImageReport& report)
      : domain_(domain),
        image_(domain.image()),
        options_(options),
        log_(log),
        progress_(progress),
        report_(report),
        refine_(refine_options(image_, options)),
        improve_(options.improve) {
    improve_.keep_topology = keeps_topology();
  }

  /// From the clean image to the mesh in local mm.
  MaterialMesh run() {
    build_lattice();           // section 3.3.1
    refine_adaptively();       // 3.3.2 and 3.3.3
    check_lattice_topology();  // 3.3.4
    keep_candidate();
    if (options_.mixed && !options_.improve.enabled) mix_lattice_elements();  // 3.4
    if (options_.deform.iterations > 0) deform();                             // 3.5
    if (options_.improve.enabled) improve();
    warn_of_missing_hexes(options_, report_);
    warn_of_topology_differences(report_);
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool keeps_topology() const {
    return options_.topology.enabled && options_.refine.keep_topology;
  }

  void build_lattice() {
    lattice_ = log_.run("bcc_lattice", 0.02, [&] {
      return build_bcc_lattice(image_, lattice_options(image_, options_, report_));
    });
    if (log_.dumping()) log_.dump("1_bcc_lattice", as_material_mesh(lattice_));
  }

  void refine_adaptively() {
    if (options_.edge_length_mm > 0 && improve_.enabled) {
      scale_lengths(options_.edge_length_mm / (tolerances::kEdgesPerReach * refine_.max_distance_mm), refine_,
                    improve_);
    }
    report_.refine = log_.run("adaptive_refinement", 0.1, [&] { return refine_for_elements(); });
    candidate_ = std::move(report_.refine.mesh);
    report_.finest_spacing_mm = lattice_.frame.spacing_mm(lattice_.frame.max_level);
  }

  /// The refinement, and again with smaller lengths while the lattice has too few tets for the decimation to
  /// choose from, where a number of elements is asked for.
  RefineResult refine_for_elements() {
    constexpr double kTetsPerElement =
        5.5;  // a lattice mesh has about five times the tets of the finished one
    constexpr double kLeastShrinking = 0.8, kMostShrinking = 0.5;
    constexpr int kTurns = 8;
    RefineResult result = refine_once();
    for (int turn = 0; options_.elements > 0 && turn < kTurns; ++turn) {
      const double share = static_cast<double>(labelled_tets(result.mesh)) /
                           (kTetsPerElement * static_cast<double>(options_.elements));
      if (share >= 1) {
        break;
      }
      scale_lengths(std::clamp(std::sqrt(share), kMostShrinking, kLeastShrinking), refine_, improve_);
      result = refine_once();
    }
    return result;
  }

  RefineResult refine_once() {
    return refine_lattice(lattice_, domain_, refine_, [this](int round, std::size_t tets) {
      require_work_within_limit(options_.work_limit_s, tets_of_rounds_ += tets, tets);
      progress_.step(
          "adaptive_refinement, round " + std::to_string(round) + ", " + std::to_string(tets) + " tets",
          std::min(0.5, 0.1 + 0.03 * round));
    });
  }

  void check_lattice_topology() {
    if (!options_.topology.enabled) {
      return;
    }
    report_.topology = log_.run("topology_checks", 0.45, [&] {
      return check_topology(candidate_, local_points(lattice_), domain_, options_.topology);
    });
    warn_of_topology(options_, report_);
    if (options_.refine.keep_topology) {
      compare_topology(image_, lattice_, candidate_, report_);
    }
  }

  void keep_candidate() {
    mesh_ = log_.run("candidate_mesh", 0.5, [&] {
      MaterialMesh kept =
          discard_background(local_points(lattice_), candidate_.tets.nodes, candidate_.materials);
      order_for_locality(kept);
      // Nothing of the lattice is asked for from here on.
      candidate_ = {};
      lattice_ = {};
      return kept;
    });
    log_.dump("2_candidate_mesh", mesh_);
    report_.warnings.insert(report_.warnings.end(), report_.refine.warnings.begin(),
                            report_.refine.warnings.end());
    warn_of_losses(image_, mesh_, report_);
  }

  void mix_lattice_elements() {
    report_.mix = log_.run("mixed_elements", 0.53, [&] { return mix_elements(mesh_, options_.mix); });
    log_.dump("3_mixed_mesh", mesh_);
  }

  void deform() {
    report_.deform = log_.run("deformation", 0.55, [&] {
      return deform_mesh(mesh_, image_, options_.deform, [&](int i) {
        progress_.step("deformation, iteration " + std::to_string(i + 1),
                       0.55 + 0.4 * i / std::max(1, options_.deform.iterations));
      });
    });
    log_.dump("4_deformed_mesh", mesh_);
    warn_of_early_stop(report_);
  }

  /// The improvement, and around it what mixed elements need: a core that stays, and its merging.
  void improve() {
    MixOptions mix = options_.mix;
    mix.red_only = options_.deform.iterations == 0;
    const HexCore core = choose_core(mix);
    // What is merged afterwards counts as one cell.
    improve_.target_tets = options_.elements > 0 ? options_.elements + core.cells_saved : 0;
    report_.improve = log_.run("improvement", 0.5, [&] {
      return improve_mesh(
          mesh_, domain_, improve_,
          [&](int round) {
            progress_.step("improvement, round " + std::to_string(round + 1),
                           std::min(0.95, 0.5 + 0.06 * round));
          },
          core.fixed);
    });
    log_.dump("5_improved_mesh", mesh_);
    if (keeps_topology()) {
      compare_topology(image_, mesh_, report_);
    }
    merge_core(core, mix);
    warn_of_angles(options_, report_);
    warn_of_elements(options_, mesh_.cell_count(), report_);
  }

  HexCore choose_core(const MixOptions& mix) {
    if (!options_.mixed) {
      return {};
    }
    return log_.run("hex_core", 0.5, [&] { return hex_core_for(mesh_, domain_, improve_, mix); });
  }

  void merge_core(const HexCore& core, const MixOptions& mix) {
    if (options_.mixed) {
      report_.mix = log_.run("mixed_elements", 0.97, [&] { return merge_hex_core(mesh_, core, mix); });
      log_.dump("6_mixed_mesh", mesh_);
    }
  }

  const ImageDomain& domain_;
  const LabelImage& image_;
  const MeshImageOptions& options_;
  StageLog& log_;
  const Progress& progress_;
  MeshImageReport& report_;
  RefineOptions refine_;
  ImproveOptions improve_;
  std::size_t tets_of_rounds_ = 0;
  Lattice lattice_;
  CandidateMesh candidate_;
  MaterialMesh mesh_;
};

/// A wish that nothing would come of is refused.
void require_dial_has_effect(const MeshImageOptions& options) {
  const bool improves = options.improve.enabled;
  for (const auto& [name, asked] : {std::pair{"elements", options.elements > 0},
                                    std::pair{"edge_length_mm", options.edge_length_mm > 0}}) {
    if (asked && !improves) {
      throw InputError(std::string(name) +
                           ": only the improvement of preset quality keeps to it; leave it out or set "
                           "lattice_spacing_mm",
                       name);
    }
  }
  if (options.elements > 0 && options.edge_length_mm > 0) {
    throw InputError("elements and edge_length_mm: give one of the two", "elements");
  }
}

/// Cleans and meshes the image and hands the mesh in local mm to `finish` with the domain that it was made
/// for.
template <typename Finish>
auto mesh_and_finish(LabelImage image, const MeshImageOptions& options, const Progress& progress,
                     MeshImageReport& report, const Finish& finish) {
  require_dial_has_effect(options);
  StageLog log(image, options, progress, report);

  report.clean = log.run("image_cleaning", 0.01, [&] { return clean_image(image, options.clean, true); });
  warn_of_cleaning(report.clean, report);

  const ImageDomain domain(image, options.domain);  // the image does not change any more
  const MaterialMesh mesh = CleanImageMeshing(domain, options, log, progress, report).run();
  auto finished = finish(mesh, domain, log);
  log.report_seconds();
  return finished;
}

}  // namespace

Mesh mesh_image(LabelImage image, const MeshImageOptions& options, const Progress& progress,
                MeshImageReport& report) {
  return mesh_and_finish(std::move(image), options, progress, report,
                         [](const MaterialMesh& mesh, const ImageDomain& domain, StageLog& /*log*/) {
                           return to_physical_mesh(mesh, domain.image());
                         });
}

QuadraticMesh mesh_image_quadratic(LabelImage image, const MeshImageOptions& options,
                                   const Progress& progress, MeshImageReport& report) {
  if (options.mixed) {
    throw InputError(
        "mixed: pyramids and hexahedra have no quadratic form here; leave it out or take order 1", "mixed");
  }
  return mesh_and_finish(std::move(image), options, progress, report,
                         [&report](const MaterialMesh& mesh, const ImageDomain& domain, StageLog& log) {
                           return log.run("quadratic_tets", 0.98, [&] {
                             return curved_quadratic_mesh(mesh, domain, {}, report.curve);
                           });
                         });
}

}  // namespace cbc3d
