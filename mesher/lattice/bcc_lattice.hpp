// Stage "BCC lattice construction" (paper, section "Adaptive Lattice Refinement"): the uniform coarse
// lattice.
#pragma once

#include "mesher/core/label_image.hpp"
#include "mesher/lattice/lattice.hpp"

namespace cbc3d {

struct BccLatticeOptions {
  double spacing_mm = 10;        ///< edge of the lattice cubes, mm
  double finest_spacing_mm = 1;  ///< refinement may not go below this spacing, mm; sets the deepest level
};

/// Covers the labelled voxels of `image` with BCC tets, in the image's local frame and centred on the
/// labelled region, and leaves out the tets wholly outside. A ring of tets around those that hold labelled
/// voxels is kept until the background is discarded: so every vertex near a surface has its whole star, which
/// the topological checks rely on. Throws InputError when the spacing is so small for this image that the
/// lattice cannot be indexed.
Lattice build_bcc_lattice(const LabelImage& image, const BccLatticeOptions& options);

/// The spacing that is taken where none is given: ten times the geometric mean of the voxel spacing, which is
/// close to the paper's choice in three of its four cases (10 mm for about 1 mm voxels, .15 mm for the
/// stent).
double default_lattice_spacing_mm(const ImageFrame& frame);

/// The finest that a fidelity alone makes the lattice where nothing is given: the smallest voxel spacing; of
/// needle or plate voxels no less than half the geometric mean, for a lattice of equal-sided elements as fine
/// as a voxel's thinnest side would have no end.
double default_finest_spacing_mm(const ImageFrame& frame);

}  // namespace cbc3d
