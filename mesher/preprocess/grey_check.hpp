// Whether an image that was given as a label image is a grey one.
#pragma once

#include <cstddef>
#include <string>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// How much of an image is in one piece. In grey images most voxels differ from those beside them, in label
/// images few do: of atlases with 30 to 724 labels at most 1 % of the voxels stand alone and 18 % of the
/// faces between labelled voxels are between unlike ones, of brain scans at least 37 % and 71 %.
struct LabelTexture {
  std::size_t labels = 0;         ///< without background
  std::size_t voxels = 0;         ///< labelled
  std::size_t single_voxels = 0;  ///< labelled, and no face neighbour has the same label
  std::size_t faces = 0;          ///< between labelled voxels
  std::size_t unlike_faces = 0;   ///< of them, between two labels
};
/// Counts every `slice_step`-th slice alone.
LabelTexture texture_of(const LabelImage& image, int slice_step = 1);

/// More labels than this, and a share of single voxels or of unlike faces above these, mean a grey image.
inline constexpr std::size_t kManyLabels = 30;
inline constexpr double kMostSingleVoxels = 0.05, kMostUnlikeFaces = 0.5;

/// With fewer labels, noise is as many voxels that stand alone and a share of them above this,
inline constexpr std::size_t kManySingleVoxels = 2000;
inline constexpr double kMostNoise = 0.5;
/// or as many edge contacts (voxel_contacts.hpp) and more of them to a labelled voxel than this.
/// Segmentations have at most .05, a fine wire mesh; random labels .5. Every contact costs tens of elements
/// and every voxel alone a hundred, so that a file of some kilobytes would take minutes or hours.
inline constexpr std::size_t kManyContacts = 2000;
inline constexpr double kMostContacts = 0.1;

/// Why the image looks grey or like noise, with the figures; empty where it does not.
std::string why_grey(const LabelImage& image);

}  // namespace cbc3d
