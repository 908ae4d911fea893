// The segmented multi-label image, which every room uses.
//
// Notation: i, j, k   voxel indices, i fastest in memory;
//           local mm  index times spacing: the frame of the image's own axes, origin at the centre of voxel
//           (0,0,0); physical  LPS mm: origin + direction * local (the ITK convention).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "mesher/core/label_voxels.hpp"
#include "mesher/core/vec3.hpp"

namespace cbc3d {

/// A label value as the image's file has it (any 32-bit integer; 0 is background).
using Label = std::int32_t;

/// Where the voxels of an image lie in physical space.
struct ImageFrame {
  Index3 size{0, 0, 0};              ///< voxels along each axis
  Vec3 spacing_mm{1, 1, 1};          ///< distance of voxel centres along each axis, > 0
  Vec3 origin_mm{0, 0, 0};           ///< physical position of the centre of voxel (0,0,0)
  Mat3 direction{Mat3::identity()};  ///< columns: the image axes in physical space, orthonormal

  [[nodiscard]] std::size_t voxel_count() const {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
           static_cast<std::size_t>(size[2]);
  }
  [[nodiscard]] std::size_t offset(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  [[nodiscard]] Index3 index_of(std::size_t offset) const;
  /// Centre of voxel (i,j,k) in local mm.
  [[nodiscard]] Vec3 local_centre(int i, int j, int k) const {
    return {i * spacing_mm[0], j * spacing_mm[1], k * spacing_mm[2]};
  }
  /// The voxel whose centre is nearest to a local position; none outside the image.
  [[nodiscard]] std::optional<Index3> voxel_at_local(const Vec3& local_mm) const;
  [[nodiscard]] Vec3 to_physical(const Vec3& local_mm) const { return origin_mm + direction * local_mm; }
  [[nodiscard]] Vec3 to_local(const Vec3& physical_mm) const {
    return direction.transposed() * (physical_mm - origin_mm);
  }
  /// True when the image axes form a left-handed system, so that a map to physical space turns elements
  /// inside out.
  [[nodiscard]] bool left_handed() const { return direction.determinant() < 0; }
  /// Length of the space diagonal of one voxel, mm.
  [[nodiscard]] double voxel_diagonal_mm() const { return spacing_mm.norm(); }
};

/// A label image in memory. Voxels hold material indices; `labels[m]` is the label value of material m.
struct LabelImage {
  ImageFrame frame;
  std::vector<Label> labels{
      0};              ///< labels[0] = 0 (background); the rest ascending and distinct when read from a file
  LabelVoxels voxels;  ///< frame.voxel_count() entries, i fastest

  [[nodiscard]] MaterialId at(int i, int j, int k) const { return voxels[frame.offset(i, j, k)]; }
  /// Material at (i,j,k); background outside the image.
  [[nodiscard]] MaterialId at_or_background(int i, int j, int k) const {
    return frame.contains(i, j, k) ? at(i, j, k) : kBackground;
  }
  /// Material of the voxel whose centre is nearest to a local position; background outside the image.
  [[nodiscard]] MaterialId at_local(const Vec3& local_mm) const;
  [[nodiscard]] std::size_t material_count() const { return labels.size(); }
  /// Number of voxels of every material, computed in parallel.
  [[nodiscard]] std::vector<std::size_t> voxels_per_material() const;
};

/// The value of every material's label, `otherwise` where the label has none. `labels` as in LabelImage.
std::vector<double> values_of_materials(const std::vector<Label>& labels,
                                        const std::map<Label, double>& of_label, double otherwise);

/// True when a voxel has a face neighbour of another material; the outside of the image counts as background.
/// This is the paper's boundary voxel (its signed distance map is zero there).
bool is_boundary_voxel(const LabelImage& image, int i, int j, int k);

/// The centre of the nearest boundary voxel of a material's label within `reach_mm` of a place, local mm; for
/// background: of a voxel of any label with background beside it.
std::optional<Vec3> nearest_boundary_voxel(const LabelImage& image, const Vec3& local_mm, MaterialId material,
                                           double reach_mm);

/// True when there is one; cheaper than finding the nearest.
bool has_boundary_voxel_near(const LabelImage& image, const Vec3& local_mm, MaterialId material,
                             double reach_mm);

/// The first material of each material's label: several have one where the regions of a label are materials
/// of their own.
std::vector<MaterialId> first_of_label(const LabelImage& image);

}  // namespace cbc3d
