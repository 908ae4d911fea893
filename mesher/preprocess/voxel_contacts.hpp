// Stage "Eliminating non-manifold voxel connectivity" (paper, section "Image pre-processing").
//
// Notation: vertex contact  two voxels of one label on a space diagonal of a 2x2x2 cell, none of the other
// six of that label;
//           edge contact    two voxels of one label on a diagonal of a 2x2 square, neither of the other two
//           of that label.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

struct ContactReport {
  std::size_t vertex_contacts = 0;  ///< found in the image as it came
  std::size_t edge_contacts = 0;
  std::size_t voxels_changed = 0;  ///< changes made, a voxel changed twice counts twice
  std::size_t joined = 0;          ///< changes by which a label's voxels were joined through faces
  std::size_t cut = 0;             ///< changes by which they were parted
  std::size_t contacts_left = 0;   ///< places where a contact could not be removed
  int rounds = 0;
  std::vector<std::ptrdiff_t> gained;  ///< voxels by material, fewer than none where it lost some
};

/// Removes all contacts of all labelled materials by the paper's templates: a vertex contact takes one of the
/// six paths of two voxels that join the two by faces, an edge contact one of the two voxels. The choice is a
/// hash of place, seed and round, so a run repeats at any thread count.
///
/// It always ends. Materials have a priority: background lowest, then the smaller the material the higher. A
/// voxel only ever changes to a material of higher priority: templates that would overwrite a higher one are
/// barred, among the others those that overwrite background only go first, and where all are barred one of
/// the two voxels in contact gives way to its higher neighbour instead. The sum of priorities grows with each
/// change and is bounded.
ContactReport remove_voxel_contacts(LabelImage& image, std::uint64_t seed);

/// Contacts in an image; those of different labels or places count separately.
ContactReport count_voxel_contacts(const LabelImage& image);

}  // namespace cbc3d
