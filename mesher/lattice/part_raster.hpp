// Which parts of voxels (voxel_topology.hpp) lie in tets of other materials than their own.
#pragma once

#include <array>
#include <vector>

#include "mesher/lattice/candidate_mesh.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/lattice/voxel_topology.hpp"

namespace cbc3d {

class PartRaster {
 public:
  /// The image must outlive this.
  PartRaster(const LabelImage& image, const LatticeFrame& lattice, int fewest = kHalves)
      : image_(image),
        parts_(voxel_parts(image.frame, fewest)),
        frame_(part_frame(image.frame, fewest)),
        raster_(image.frame, lattice, parts_) {}

  /// Those of the whole mesh, by offset. Parallel; the same at any thread count.
  [[nodiscard]] std::vector<MisplacedPart> misplaced(const Lattice& lattice, const CandidateMesh& mesh) const;

  /// True when the tet holds a part of a voxel of another material than `own`.
  [[nodiscard]] bool holds_other(const std::array<LatticePoint, 4>& tet, MaterialId own) const;

 private:
  [[nodiscard]] MaterialId material_of(int i, int j, int k) const {
    return image_.at(i / parts_[0], j / parts_[1], k / parts_[2]);
  }
  void add_misplaced(const std::array<LatticePoint, 4>& tet, MaterialId own,
                     std::vector<MisplacedPart>& misplaced) const;

  const LabelImage& image_;
  Index3 parts_;  // of a voxel, by axis
  ImageFrame frame_;
  VoxelRaster raster_;
};

/// Offsets of voxels in the image, ascending.
struct TopologyDifferences {
  std::vector<std::size_t> places;     ///< find_topology_differences
  std::vector<std::size_t> misplaced;  ///< all voxels with misplaced parts
};

/// Where labels have another topology in the mesh than in the image. Where halves of voxels show no place,
/// which happens with tunnels narrower than they are, quarters are looked at.
TopologyDifferences find_topology_differences(const LabelImage& image, const Lattice& lattice,
                                              const CandidateMesh& mesh, const std::vector<Label>& labels);

}  // namespace cbc3d
