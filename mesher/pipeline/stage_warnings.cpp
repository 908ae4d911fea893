#include "mesher/pipeline/stage_warnings.hpp"

#include <cmath>
#include <cstdio>
#include <map>

namespace cbc3d {
namespace {

/// The regions of a label, and those of them that are not in the mesh.
struct Loss {
  std::size_t regions = 0, lost_regions = 0, lost_voxels = 0;
};

std::map<Label, Loss> losses_of(const LabelImage& image, const MaterialMesh& mesh) {
  std::vector<std::uint8_t> there(image.material_count(), 0);
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    there[mesh.material_of(c)] = 1;
  }
  std::map<Label, Loss> losses;
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  for (std::size_t m = 1; m < there.size(); ++m) {
    Loss& loss = losses[image.labels[m]];
    ++loss.regions;
    loss.lost_regions += there[m] == 0 ? 1 : 0;
    loss.lost_voxels += there[m] == 0 ? voxels[m] : 0;
  }
  return losses;
}

std::string what_is_lost(Label label, const Loss& loss) {
  const std::string named = "label " + std::to_string(label);
  return loss.lost_regions == loss.regions ? named
                                           : std::to_string(loss.lost_regions) + " of " +
                                                 std::to_string(loss.regions) + " regions of " + named;
}

std::string betti_text(const Betti& betti) {
  return std::to_string(betti.parts) + ", " + std::to_string(betti.tunnels) + ", " +
         std::to_string(betti.cavities);
}

}  // namespace

void warn_of_losses(const LabelImage& image, const MaterialMesh& mesh, MeshImageReport& report) {
  for (const auto& [label, loss] : losses_of(image, mesh)) {
    if (loss.lost_regions > 0) {
      report.warnings.push_back(
          what_is_lost(label, loss) + " (" + std::to_string(loss.lost_voxels) +
          " voxels) not in the mesh; a smaller lattice_spacing_mm or max_distance_mm keeps more");
    }
  }
}

void warn_of_early_stop(MeshImageReport& report) {
  if (report.deform.stopped_early) {
    report.warnings.push_back("the deformation stopped in iteration " +
                              std::to_string(report.deform.iterations.size()) +
                              ": elements stay below the minimum quality; on_failure recover goes on");
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

void warn_of_elements(const MeshImageOptions& options, std::size_t cells, MeshImageReport& report) {
  const auto wanted = static_cast<double>(options.elements);
  if (options.elements > 0 && std::fabs(static_cast<double>(cells) - wanted) > 0.1 * wanted) {
    report.warnings.push_back("elements " + std::to_string(options.elements) +
                              " could not be met: the mesh has " + std::to_string(cells));
  }
}

}  // namespace cbc3d
