// How many voxels the sub-mesh of every material has and shares with the image, while tets come, go and
// change their material (paper, section "Adaptive Lattice Refinement", the fidelity F).
//
// Every labelled voxel lies in exactly one tet of the lattice. So it is enough to count the voxels that lie
// in a tet of another material, and nearly all tets have none and are passed over.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/voxel_raster.hpp"

namespace cbc3d {

/// Which materials other than its own a tet has voxels of: bit m % 8 for material m. 0: the tet is pure.
using ForeignMaterials = std::uint8_t;

class FidelityAccount {
 public:
  /// `voxels`: of every material in the image. The others must outlive this.
  FidelityAccount(const LabelImage& image, const VoxelRaster& raster, std::vector<std::size_t> voxels)
      : image_(image),
        raster_(raster),
        voxels_(std::move(voxels)),
        sums_{std::vector<std::ptrdiff_t>(voxels_.size(), 0),
              std::vector<std::ptrdiff_t>(voxels_.size(), 0)} {}

  /// Changes of the account, one entry per material.
  struct Changes {
    std::vector<std::ptrdiff_t> missing;    ///< voxels of the material in tets of others
    std::vector<std::ptrdiff_t> intruding;  ///< voxels of others in tets of the material
  };
  [[nodiscard]] Changes no_changes() const {
    const std::vector<std::ptrdiff_t> zero(voxels_.size(), 0);
    return {zero, zero};
  }

  /// A tet enters the account as one of `material`; returns what is foreign in it. Any thread.
  [[nodiscard]] ForeignMaterials enter(const std::array<LatticePoint, 4>& tet, MaterialId material,
                                       Changes& changes) const;
  /// A tet that entered it as one of `material` leaves it. Any thread.
  void leave(const std::array<LatticePoint, 4>& tet, MaterialId material, Changes& changes) const {
    count_foreign(tet, material, -1, changes);
  }
  /// Adds a thread's changes up; one thread at a time.
  void add(const Changes& changes);

  /// |S2|
  [[nodiscard]] std::size_t image_voxels(std::size_t material) const { return voxels_[material]; }
  /// |S1 n S2|
  [[nodiscard]] std::size_t common_voxels(std::size_t material) const {
    return voxels_[material] - static_cast<std::size_t>(sums_.missing[material]);
  }
  /// |S1|
  [[nodiscard]] std::size_t mesh_voxels(std::size_t material) const {
    return common_voxels(material) + static_cast<std::size_t>(sums_.intruding[material]);
  }

  /// True when a tet of `own`, with these materials in it, holds a voxel of another one for which, or for its
  /// own, `unmet` is not 0.
  [[nodiscard]] bool is_misjudged(const std::array<LatticePoint, 4>& tet, MaterialId own,
                                  ForeignMaterials foreign, const std::vector<std::uint8_t>& unmet) const;

 private:
  [[nodiscard]] bool is_surely_pure(const std::array<LatticePoint, 4>& tet, MaterialId material) const;
  ForeignMaterials count_foreign(const std::array<LatticePoint, 4>& tet, MaterialId material,
                                 std::ptrdiff_t sign, Changes& changes) const;

  const LabelImage& image_;
  const VoxelRaster& raster_;
  std::vector<std::size_t> voxels_;
  Changes sums_;
};

}  // namespace cbc3d
