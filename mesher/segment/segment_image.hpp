// From a grey image to a label: the paper's segmentation of vessels (fast marching, then a level set), with
// ITK.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/progress.hpp"

namespace cbc3d {

/// When the fast marching front has come far enough.
enum class FrontStop { first_target, all_targets };

struct SegmentOptions {
  std::vector<Vec3> seeds_mm;    ///< physical positions within the structure, where the front starts
  std::vector<Vec3> targets_mm;  ///< physical positions that it is to reach: far ends, or a point of the wall
  FrontStop stop = FrontStop::first_target;  ///< the paper's choice
  std::optional<int> volume{};               ///< of a 4-D image, counted from 0
  double sigma_mm =
      0;  ///< of the Gaussian under which gradients and levels are taken; 0: 3/4 of the mean spacing
  double edge_gradient = 0;    ///< gradient at the wall, grey values a mm; 0: measured around the seeds
  double contrast = 0;         ///< grey value inside less that outside; 0: measured around the seeds
  double propagation = 0.6;    ///< weight of the outward push against the pull to the wall (1)
  double curvature = 0.1;      ///< weight of the surface tension, which smoothes and cuts thin parts
  int iterations = 200;        ///< of the level set, at most
  double least_change = 1e-3;  ///< of the level set a step (root mean square, voxels) at which it ends
};

struct SegmentReport {
  double sigma_mm = 0, edge_gradient = 0, noise_gradient = 0, inside_level = 0, outside_level = 0;
  std::size_t front_voxels = 0;  ///< that the front had covered when it stopped
  int iterations = 0;            ///< of the level set
  std::size_t voxels = 0;        ///< of the structure
};

/// Segments the structure that the seeds lie in: `voxels` of the result are 1 (label 1) within it. The speed
/// of the front falls at edges (a sigmoid of the gradient's size) and where the grey value is nearer to that
/// around the structure; what it has covered when a target is met starts a geodesic active contour
/// (V. Caselles et al. 1997), whose inside is the result. Throws InputError for an image that cannot be read
/// or is not 3-D, seeds or targets outside it or absent, and seeds around which there is no edge.
LabelImage segment_image(const std::filesystem::path& grey_image, const SegmentOptions& options,
                         const Progress& progress, SegmentReport& report);

}  // namespace cbc3d
