// The mesh that the preset "paper" hands to the deformation.
#pragma once

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/mixed/mix_elements.hpp"
#include "mesher/preprocess/clean_image.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d::testing {

struct PaperMeshOptions {
  double spacing_mm = 10;
  double finest_spacing_mm = 0;  ///< 0: the smallest voxel spacing
  bool mixed = false;
  CleanOptions clean = {};
};

/// The candidate mesh of an image, which is cleaned; with mixed elements where they are asked for.
inline MaterialMesh paper_mesh_of_cleaned(LabelImage& image, const PaperMeshOptions& options) {
  clean_image(image, options.clean, true);
  RefineOptions refine;
  refine.finest_spacing_mm =
      options.finest_spacing_mm > 0 ? options.finest_spacing_mm : image.frame.spacing_mm.min_coeff();
  Lattice lattice = build_bcc_lattice(image, {options.spacing_mm, refine.finest_spacing_mm});
  const CandidateMesh candidate =
      refine_lattice(lattice, ImageDomain(image), refine, [](int, std::size_t) {}).mesh;
  MaterialMesh mesh = discard_background(local_points(lattice), candidate.tets.nodes, candidate.materials);
  order_for_locality(mesh);
  if (options.mixed) {
    mix_elements(mesh, {});
  }
  return mesh;
}

/// The same with the materials of the image as it is.
inline MaterialMesh paper_mesh(const LabelImage& image, const PaperMeshOptions& options) {
  LabelImage cleaned = image;
  const MaterialMesh mesh = paper_mesh_of_cleaned(cleaned, options);
  return to_material_mesh(to_physical_mesh(mesh, cleaned), image);
}

}  // namespace cbc3d::testing
