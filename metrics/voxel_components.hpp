// Connected components of a material's voxels, or of all other voxels, within a box.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "metrics/image_boundary.hpp"

namespace cbc3d::metrics {

/// The smallest box around each material's voxels, by material.
std::vector<VoxelBox> boxes_of_materials(const LabelImage& image);

struct VoxelComponent {
  std::int64_t voxels = 0;
  bool reaches_border = false;  ///< a voxel of it lies at the border of the box
  Index3 place{};               ///< its voxel nearest to its centroid
};

/// Runs of voxels along rows, joined. The set is a material, or with `complement` all that is not the
/// material; what lies outside the image is not the material, and the box may reach there. Memory is
/// proportional to the runs, time too but for the reading of the voxels.
class VoxelComponents {
 public:
  struct Set {
    MaterialId material;
    bool complement;
    bool joins_at_corners;  ///< 26-connected; else 6-connected
  };
  VoxelComponents(const LabelImage& image, const Set& set, const VoxelBox& box);

  [[nodiscard]] const std::vector<VoxelComponent>& components() const { return components_; }
  /// The component of a voxel; nothing outside the set or the box.
  [[nodiscard]] std::optional<std::uint32_t> find(const Index3& voxel) const;

 private:
  struct Run {
    int begin, end;
  };
  [[nodiscard]] std::size_t row(int j, int k) const;
  void find_runs(const LabelImage& image, const Set& set);
  void join_runs(bool at_corners);
  void describe();

  VoxelBox box_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_;        // run of every row of the box, and the end
  std::vector<std::uint32_t> component_;  // of every run
  std::vector<VoxelComponent> components_;
};

}  // namespace cbc3d::metrics
