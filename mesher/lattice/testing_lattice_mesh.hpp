// The mesh of an image before its improvement.
#pragma once

#include "mesher/domain/image_domain.hpp"
#include "mesher/domain/tolerances.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d::testing {

/// The mesh that the preset "quality" hands to the improvement, but of the image as it is: the distance
/// criterion for every interface, smooth labels and repaired topology.
inline MaterialMesh lattice_mesh(const LabelImage& image,
                                 double max_distance_diagonals = tolerances::kReach) {
  const ImageDomain domain(image);
  const double diagonal_mm = image.frame.voxel_diagonal_mm();
  RefineOptions refine;
  refine.fidelity = 0.01;
  refine.max_distance_mm = max_distance_diagonals * diagonal_mm;
  refine.each_interface = true;
  refine.max_vertex_distance_mm = tolerances::kLatticeFarLimit * diagonal_mm;
  refine.contact_distance_mm = tolerances::kContact * diagonal_mm;
  refine.smooth_labels = true;
  refine.one_face_rule = false;
  refine.topology_checks = true;
  refine.topology_rounds = 0;
  refine.repair_rounds = 4;
  refine.repair_image_passes = 4;
  refine.finest_spacing_mm = image.frame.spacing_mm.min_coeff();
  TopologyOptions topology;
  topology.enabled = true;
  topology.one_face_rule = false;
  topology.image_passes = 4;
  topology.small_component = 0;
  Lattice lattice =
      build_bcc_lattice(image, {default_lattice_spacing_mm(image.frame), refine.finest_spacing_mm / 4});
  CandidateMesh candidate = refine_lattice(lattice, domain, refine, [](int, std::size_t) {}).mesh;
  check_topology(candidate, local_points(lattice), domain, topology);
  MaterialMesh mesh = discard_background(local_points(lattice), candidate.tets.nodes, candidate.materials);
  order_for_locality(mesh);
  return mesh;
}

}  // namespace cbc3d::testing
