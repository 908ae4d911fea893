// Components, Euler characteristic and Betti numbers of the labels of an image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::metrics {

/// Betti numbers b0 components, b1 tunnels, b2 cavities; ball 1 0 0, solid torus 1 1 0, shell 1 0 1.
struct Betti {
  std::array<std::int64_t, 3> b{};
  [[nodiscard]] std::int64_t euler() const { return b[0] - b[1] + b[2]; }
  bool operator==(const Betti&) const = default;
};

/// A set of voxels taken in the two ways there are. Where voxels of it touch at an edge or a corner alone the
/// two differ, and a mesh may do either.
struct VoxelSetTopology {
  Betti closed;                ///< voxels with their boundary: 26-connected, its complement 6-connected
  Betti open;                  ///< without: 6-connected, its complement 26-connected
  std::int64_t ambiguous = 0;  ///< corners of voxels at which the two differ
};

/// Eight times what a corner of the voxel grid adds to the Euler characteristic of a set of voxels, by which
/// of the 8 voxels at it (bit x + 2y + 4z) are in the set. The corner has 6 half edges and 12 quarter faces;
/// each of them belongs to 2 and to 4 corners, each voxel to 8.
struct CornerTables {
  std::array<int, 256> closed, open;
};
CornerTables corner_tables();

/// An image with more labels than this gets no topology per label: its cost grows with regions times labels.
inline constexpr std::size_t kMostLabelsWithTopology = 4096;

struct ImageTopology {
  std::vector<VoxelSetTopology> per_material;  ///< background's entry is empty; none with too many labels
  VoxelSetTopology all;                        ///< all labels as one set
};

/// Time linear in the voxels (and regions times labels), memory in the runs of equal voxels along rows.
ImageTopology image_topology(const LabelImage& image);

/// The topology of a label, null where the image has not the label or too many. `image` as read from a file,
/// its labels ascending.
const VoxelSetTopology* find_label(const ImageTopology& topology, const LabelImage& image, Label label);

}  // namespace cbc3d::metrics
