// What meshing an image will cost, foreseen from the kinds of its boundaries before any work begins.
//
// Notation: open axis  an axis along which both face neighbours of a voxel have another label than it has
//           sheet      a labelled voxel with one open axis; wire: with two; point: with all three
//           junction   a 2x2x2 cell with voxels of three labels, background among them
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "mesher/core/label_image.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d {

struct BoundaryKinds {
  std::size_t faces = 0;  ///< between voxels of different labels, background among them
  std::size_t sheets = 0, wires = 0, points = 0;
  std::size_t junctions = 0;
  std::size_t edge_contacts = 0;  ///< as in voxel_contacts.hpp
};
BoundaryKinds boundary_kinds_of(const LabelImage& image);

/// Seconds of CPU that the default preset takes, roughly: a sum over the kinds, whose weights were fitted to
/// the logarithms of what 29 images took on a busy machine: segmentations, phantoms, grids of wires and
/// walls, blocks, checkerboards. They took from .3 to 3.4 times of it. Thin parts, junctions and contacts
/// cost the most, since the lattice is split below the voxel there.
double estimated_cpu_seconds(const BoundaryKinds& kinds, const ImageFrame& frame);

/// A file smaller than this that asks for more work than that is more often a mistake, or made to keep a
/// machine busy, than a wish. The size is set so that a real stent of 39 KB, which takes as long, passes.
/// The estimate errs by a few times, so the lattice of a file that passes is held to a work limit too.
inline constexpr std::uintmax_t kSmallFileBytes = 16384;
inline constexpr double kSmallFileCpuSeconds = 30;
inline constexpr double kSmallFileWorkLimit = 60;  ///< s

/// MeshImageOptions::work_limit_s for a file of so many bytes: none (0) where it is not small, nor where an
/// option of the lattice or the improvement is set: who asks for small elements means the work.
double work_limit_s(std::uintmax_t file_bytes, const OptionSettings& settings);

/// Seconds of CPU that a lattice foretells which has `tets` now and had `tets_of_rounds` in all rounds
/// together: 2 microseconds for each tet and round and 25 for each tet's improvement. Both were measured,
/// roughly, on layers one voxel thick, the slowest image known.
double work_of_lattice_s(std::size_t tets_of_rounds, std::size_t tets);

/// Why the file asks for more work than its size lets one expect; empty where it does not.
std::string why_long_work(const LabelImage& image, std::uintmax_t file_bytes);

}  // namespace cbc3d
