#include "mesher/pipeline/mesh_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

#include "mesher/core/error.hpp"
#include "mesher/domain/tolerances.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/part_raster.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
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

/// No label is dropped silently, and no region of one either.
void warn_of_losses(const LabelImage& image, const MaterialMesh& mesh, MeshImageReport& report) {
  std::vector<std::uint8_t> there(image.material_count(), 0);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    there[mesh.material_of(c)] = 1;
  }
  struct Loss {
    std::size_t regions = 0, lost_regions = 0, lost_voxels = 0;
  };
  std::map<Label, Loss> losses;
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  for (std::size_t m = 1; m < there.size(); ++m) {
    Loss& loss = losses[image.labels[m]];
    ++loss.regions;
    loss.lost_regions += there[m] == 0 ? 1 : 0;
    loss.lost_voxels += there[m] == 0 ? voxels[m] : 0;
  }
  for (const auto& [label, loss] : losses) {
    if (loss.lost_regions > 0) {
      const std::string what = loss.lost_regions == loss.regions
                                   ? "label " + std::to_string(label)
                                   : std::to_string(loss.lost_regions) + " of " +
                                         std::to_string(loss.regions) + " regions of label " +
                                         std::to_string(label);
      report.warnings.push_back(
          what + " (" + std::to_string(loss.lost_voxels) +
          " voxels) not in the mesh; a smaller lattice_spacing_mm or max_distance_mm keeps more");
    }
  }
}

void warn_of_cleaning(const CleanReport& clean, MeshImageReport& report) {
  if (clean.removed.regions_removed > 0) {
    report.warnings.push_back(std::to_string(clean.removed.regions_removed) + " regions (" +
                              std::to_string(clean.removed.voxels_removed) +
                              " voxels) below region_tolerance became background");
  }
  if (clean.contacts.joined + clean.contacts.cut > 0) {
    report.warnings.push_back(
        "voxels of a label touched at edges or corners alone: " + std::to_string(clean.contacts.joined) +
        " such places joined and " + std::to_string(clean.contacts.cut) + " cut, by " +
        std::to_string(clean.contacts.voxels_changed) + " voxels, so that every label has one topology");
  }
  if (clean.contacts.contacts_left > 0) {
    report.warnings.push_back(std::to_string(clean.contacts.contacts_left) +
                              " places are left where voxels of a label touch at edges or corners alone");
  }
  for (const LabelChange& change : clean.labels) {
    if (change.voxels_before > 0 && change.voxels_after == 0) {
      report.warnings.push_back("label " + std::to_string(change.label) + " (" +
                                std::to_string(change.voxels_before) +
                                " voxels) vanished in the cleaning; relabel_noise none keeps it");
    }
  }
}

void warn_of_topology(const MeshImageOptions& options, MeshImageReport& report) {
  if (!options.clean.manifold_voxels && options.topology.image_passes == 0) {
    report.warnings.emplace_back(
        "topology_checks with manifold_voxels off: contacts of voxels by an edge or a vertex are left to the "
        "mesh, which will cut or join them");
  }
  for (const LabelTopology& t : report.topology.labels) {
    if (t.components != t.image_regions) {
      report.warnings.push_back("label " + std::to_string(t.label) + " has " +
                                std::to_string(t.image_regions) +
                                " face-connected regions in the cleaned image and " +
                                std::to_string(t.components) + " in the mesh (the report has their places)");
    }
  }
  if (report.topology.non_manifold_vertices_left > 0) {
    report.warnings.push_back(std::to_string(report.topology.non_manifold_vertices_left) +
                              " vertices are left where a label's surface is non-manifold");
  }
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

std::string betti_text(const Betti& betti) {
  return std::to_string(betti.parts) + ", " + std::to_string(betti.tunnels) + ", " +
         std::to_string(betti.cavities);
}

void warn_of_topology_differences(MeshImageReport& report) {
  for (const LabelDifference& d : report.topology_differences) {
    report.warnings.push_back(
        "label " + std::to_string(d.label) + " has " + betti_text(d.in_image) +
        " parts, tunnels, cavities in the cleaned image and " + betti_text(d.in_mesh) +
        " in the mesh (evaluate names the places); a smaller finest_spacing_mm keeps more");
  }
}

void warn_of_angles(const MeshImageOptions& options, MeshImageReport& report) {
  if (report.improve.min_dihedral_after_deg < options.improve.min_dihedral_deg) {
    char text[128];
    std::snprintf(text, sizeof(text), "the smallest dihedral angle is %.2f degrees, not %.2f",
                  report.improve.min_dihedral_after_deg, options.improve.min_dihedral_deg);
    report.warnings.emplace_back(text);
  }
}

void warn_of_missing_hexes(const MeshImageOptions& options, MeshImageReport& report) {
  if (options.mixed && report.mix.hexes == 0) {
    report.warnings.emplace_back(
        "mixed: the mesh has no hexahedra, for no label is thick enough for coarse uniform elements inside; "
        "a smaller lattice_spacing_mm may help");
  }
}

/// Where the image has more parts than so few elements can hold, or the lattice is too coarse for so many.
void warn_of_elements(const MeshImageOptions& options, std::size_t tets, MeshImageReport& report) {
  const auto wanted = static_cast<double>(options.elements);
  if (options.elements > 0 && std::fabs(static_cast<double>(tets) - wanted) > 0.1 * wanted) {
    report.warnings.push_back("elements " + std::to_string(options.elements) +
                              " could not be met: the mesh has " + std::to_string(tets));
  }
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

/// The refinement, and again with smaller lengths while the lattice has too few tets for the decimation to
/// choose from, where a number of elements is asked for.
RefineResult refine_for(Lattice& lattice, const ImageDomain& domain, const MeshImageOptions& options,
                        RefineOptions& refine, ImproveOptions& improve,
                        const std::function<void(int, std::size_t)>& on_round) {
  constexpr double kTetsPerElement = 5.5;  // a lattice mesh has about five times the tets of the finished one
  constexpr double kLeastShrinking = 0.8, kMostShrinking = 0.5;
  constexpr int kTurns = 8;
  RefineResult result = refine_lattice(lattice, domain, refine, on_round);
  for (int turn = 0; options.elements > 0 && turn < kTurns; ++turn) {
    const double share = static_cast<double>(labelled_tets(result.mesh)) /
                         (kTetsPerElement * static_cast<double>(options.elements));
    if (share >= 1) {
      break;
    }
    scale_lengths(std::clamp(std::sqrt(share), kMostShrinking, kLeastShrinking), refine, improve);
    result = refine_lattice(lattice, domain, refine, on_round);
  }
  return result;
}

/// The hexes that the improvement works around. They have their places in the lattice, unless a deformation
/// has moved its vertices.
HexCore choose_core(const MaterialMesh& mesh, const ImageDomain& domain, const ImproveOptions& improve,
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

/// The improvement, and around it what mixed elements need: a core that stays, and its merging.
void improve_stage(MaterialMesh& mesh, const ImageDomain& domain, const MeshImageOptions& options,
                   ImproveOptions& improve, StageLog& log, const Progress& progress,
                   MeshImageReport& report) {
  HexCore core;
  MixOptions mix = options.mix;
  mix.red_only = options.deform.iterations == 0;
  if (options.mixed) {
    core = log.run("hex_core", 0.5, [&] { return choose_core(mesh, domain, improve, mix); });
  }
  // What is merged afterwards counts as one cell.
  improve.target_tets = options.elements > 0 ? options.elements + core.cells_saved : 0;
  report.improve = log.run("improvement", 0.5, [&] {
    return improve_mesh(
        mesh, domain, improve,
        [&](int round) {
          progress.step("improvement, round " + std::to_string(round + 1),
                        std::min(0.95, 0.5 + 0.06 * round));
        },
        core.fixed);
  });
  log.dump("5_improved_mesh", mesh);
  if (options.topology.enabled && options.refine.keep_topology) {
    compare_topology(domain.image(), mesh, report);
  }
  if (options.mixed) {
    report.mix = log.run("mixed_elements", 0.97, [&] { return merge_hex_core(mesh, core, mix); });
    log.dump("6_mixed_mesh", mesh);
  }
  warn_of_angles(options, report);
  warn_of_elements(options, mesh.cell_count(), report);
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

/// From the clean image to the mesh in local mm.
MaterialMesh mesh_clean_image(const ImageDomain& domain, const MeshImageOptions& options, StageLog& log,
                              const Progress& progress, MeshImageReport& report) {
  const LabelImage& image = domain.image();
  Lattice lattice = log.run(
      "bcc_lattice", 0.02, [&] { return build_bcc_lattice(image, lattice_options(image, options, report)); });
  if (log.dumping()) log.dump("1_bcc_lattice", as_material_mesh(lattice));

  RefineOptions refine = refine_options(image, options);
  ImproveOptions improve = options.improve;
  improve.keep_topology = options.topology.enabled && options.refine.keep_topology;
  if (options.edge_length_mm > 0 && improve.enabled) {
    scale_lengths(options.edge_length_mm / (tolerances::kEdgesPerReach * refine.max_distance_mm), refine,
                  improve);
  }
  std::size_t tets_of_rounds = 0;
  report.refine = log.run("adaptive_refinement", 0.1, [&] {
    return refine_for(lattice, domain, options, refine, improve, [&](int round, std::size_t tets) {
      require_work_within_limit(options.work_limit_s, tets_of_rounds += tets, tets);
      progress.step(
          "adaptive_refinement, round " + std::to_string(round) + ", " + std::to_string(tets) + " tets",
          std::min(0.5, 0.1 + 0.03 * round));
    });
  });
  CandidateMesh candidate = std::move(report.refine.mesh);
  report.finest_spacing_mm = lattice.frame.spacing_mm(lattice.frame.max_level);

  if (options.topology.enabled) {
    report.topology = log.run("topology_checks", 0.45, [&] {
      return check_topology(candidate, local_points(lattice), domain, options.topology);
    });
    warn_of_topology(options, report);
    if (options.refine.keep_topology) {
      compare_topology(image, lattice, candidate, report);
    }
  }

  MaterialMesh mesh = log.run("candidate_mesh", 0.5, [&] {
    MaterialMesh kept = discard_background(local_points(lattice), candidate.tets.nodes, candidate.materials);
    order_for_locality(kept);
    // Nothing of the lattice is asked for from here on.
    candidate = {};
    lattice = {};
    return kept;
  });
  log.dump("2_candidate_mesh", mesh);
  report.warnings.insert(report.warnings.end(), report.refine.warnings.begin(), report.refine.warnings.end());
  warn_of_losses(image, mesh, report);

  if (options.mixed && !options.improve.enabled) {
    report.mix = log.run("mixed_elements", 0.53, [&] { return mix_elements(mesh, options.mix); });
    log.dump("3_mixed_mesh", mesh);
  }

  if (options.deform.iterations > 0) {
    report.deform = log.run("deformation", 0.55, [&] {
      return deform_mesh(mesh, image, options.deform, [&](int i) {
        progress.step("deformation, iteration " + std::to_string(i + 1),
                      0.55 + 0.4 * i / std::max(1, options.deform.iterations));
      });
    });
    log.dump("4_deformed_mesh", mesh);
    if (report.deform.stopped_early) {
      report.warnings.push_back("the deformation stopped in iteration " +
                                std::to_string(report.deform.iterations.size()) +
                                ": elements stay below the minimum quality; on_failure recover goes on");
    }
  }
  if (options.improve.enabled) {
    improve_stage(mesh, domain, options, improve, log, progress, report);
  }
  warn_of_missing_hexes(options, report);
  warn_of_topology_differences(report);
  return mesh;
}

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

}  // namespace

namespace {

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
  const MaterialMesh mesh = mesh_clean_image(domain, options, log, progress, report);
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
