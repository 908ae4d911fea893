// The domain of a label image: its boundaries are smooth, yet on their side of every voxel centre, so that
// nothing thin is lost. They are computed where they are asked for, from 4x4x4 voxels: no memory, any number
// of labels.
//
// Field of materials a and b: +1 in voxels of a, -1 in those of b, 0 elsewhere, smoothed by (1 2 1)/4 along
// each axis (a Gaussian of .7 voxels), clamped at the voxels' centres to their own side, by `hold` or, in
// voxels that are in no 2x2x2 block of their own side, by `hold_thin`; trilinear between the centres. Near a
// plane it is about the distance in voxels.
#pragma once

#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/domain/size_rank.hpp"

namespace cbc3d {

struct ImageDomainOptions {
  double hold = 0.12;      ///< the field's least value at a voxel centre, on its own side
  double hold_thin = 0.4;  ///< the same in thin parts
};

class ImageDomain : public Domain {
 public:
  /// `image` must outlive this and must not change.
  explicit ImageDomain(const LabelImage& image, const ImageDomainOptions& options = {});

  [[nodiscard]] const LabelImage& image() const { return image_; }
  /// The voxels of every material, counted when first asked for.
  [[nodiscard]] const MaterialVoxels& voxels() const;

  [[nodiscard]] const std::vector<Label>& labels() const override { return image_.labels; }
  [[nodiscard]] const std::vector<MaterialId>& label_of() const override { return label_of_; }
  [[nodiscard]] const std::vector<double>& volumes_mm3() const override;
  [[nodiscard]] double scale_mm() const override { return image_.frame.voxel_diagonal_mm(); }
  [[nodiscard]] double cell_mm3() const override;
  [[nodiscard]] double thin_reach_mm() const override;

  [[nodiscard]] BoundaryDistance boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const override;
  /// A voxel is thin when it is in no 2x2x2 block of its own material. A sample is in a thin part when its
  /// voxel is thin, or a voxel of background across its boundary.
  [[nodiscard]] bool is_thin(const BoundarySample& sample) const override;
  /// The same of one voxel, which may be of background.
  [[nodiscard]] bool is_thin_voxel(const Index3& at) const;
  /// True for a voxel that is in no 2x2x2 block of its own material, has none but such neighbours across its
  /// faces that are, and could take its surroundings' material without a change of topology, after those
  /// before it in the image that can: noise, not shape. The smooth boundary cuts bumps off; they are not
  /// thin.
  [[nodiscard]] bool is_bump(const Index3& at) const;

  /// The material whose smoothed share is largest at x, held at the voxels' centres as the field is.
  [[nodiscard]] MaterialId material_at(const Vec3& x) const override;
  /// The boundary of a label is its boundary voxels here.
  [[nodiscard]] std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId material) const override;
  [[nodiscard]] bool is_near_boundary(const Vec3& x, MaterialId material) const override;
  /// True when every two of the materials meet, at least by a corner of voxels, within a distance of x.
  [[nodiscard]] bool all_meet_near(const Vec3& x, const MaterialSet& set, double distance_mm) const;

 protected:
  [[nodiscard]] std::vector<BoundarySample> find_samples() const override;

 private:
  /// The smoothed and clamped field at the eight voxel centres from `low` on; false where a or b is in none
  /// of the 4x4x4 voxels around them: what the field says there of a third material means nothing.
  bool corners(const Index3& low, MaterialId a, MaterialId b, std::array<double, 8>& corner) const;
  /// The same, computed; corners() keeps what a thread asked for last.
  bool find_corners(const Index3& low, MaterialId a, MaterialId b, std::array<double, 8>& corner) const;
  [[nodiscard]] double clamped(double value, const std::array<signed char, 64>& side, int at,
                               const Index3& voxel) const;
  /// By way of the nearest voxels of a and of b.
  [[nodiscard]] BoundaryDistance far_boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const;

  const LabelImage& image_;
  ImageDomainOptions options_;
  std::uint64_t number_;  // of this domain, which no other has
  std::vector<MaterialId> label_of_;
  double voxel_mm_;  // geometric mean of the spacings
  mutable std::once_flag voxels_once_;
  mutable MaterialVoxels voxels_;
  mutable std::vector<double> volumes_mm3_;
  mutable std::once_flag bumps_once_;
  mutable std::vector<std::size_t> bumps_;  // offsets, ascending
};

}  // namespace cbc3d
