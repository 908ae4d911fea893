// The paper's section "Image pre-processing": noisy voxels, disconnected regions, non-manifold voxel
// connectivity.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/preprocess/voxel_contacts.hpp"
#include "mesher/preprocess/voxel_noise.hpp"
#include "mesher/preprocess/voxel_regions.hpp"

namespace cbc3d {

struct CleanOptions {
  NoisyVoxels relabel_noise = NoisyVoxels::none;  ///< which noisy voxels are relabelled
  double region_tolerance = 1e-4;  ///< regions smaller than this share of their material are removed; 0: none
  bool manifold_voxels = true;     ///< remove vertex and edge contacts
  bool well_composed = false;  ///< with manifold_voxels: those of every label's complement too, joined rather
                               ///< than cut (well_composed.hpp), in place of the paper's templates
  std::uint64_t seed = 1;      ///< of the choice among templates
};

struct LabelChange {
  Label label = 0;
  std::size_t voxels_before = 0;
  std::size_t voxels_after = 0;
};

struct CleanReport {
  NoiseReport noise;
  RegionReport removed;
  ContactReport contacts;
  RegionReport regions;             ///< of the clean image
  std::vector<LabelChange> labels;  ///< one per label, background left out
};

/// Cleans `image` in place. Small regions go first and contacts are removed before the regions are split, so
/// that parts of a label which touch only by an edge or a vertex become one region and not two materials with
/// a non-manifold seam. A label can vanish only as noise (a label all of whose voxels are specks); the report
/// tells. Same result at any thread count. `split` false leaves the materials as they are (for writing the
/// image).
CleanReport clean_image(LabelImage& image, const CleanOptions& options, bool split);

}  // namespace cbc3d
