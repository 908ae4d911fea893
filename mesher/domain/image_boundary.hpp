// The boundary that a label image means: smooth, yet on its side of every voxel centre, so that nothing thin
// is lost. Computed where it is asked for, from 4x4x4 voxels: no memory, any number of labels.
//
// Field of materials a and b: +1 in voxels of a, -1 in those of b, 0 elsewhere, smoothed by (1 2 1)/4 along
// each axis (a Gaussian of .7 voxels), clamped at the voxels' centres to their own side, by `hold` or, in
// voxels that are in no 2x2x2 block of their own side, by `hold_thin`; trilinear between the centres. Near a
// plane it is about the distance in voxels.
#pragma once

#include <vector>

#include "mesher/domain/boundary.hpp"

namespace cbc3d {

struct ImageBoundaryOptions {
  double hold = 0.12;      ///< least value at a voxel centre of its own side
  double hold_thin = 0.4;  ///< the same in thin parts
};

class ImageBoundary : public Boundary {
 public:
  /// `image` must outlive this.
  ImageBoundary(const LabelImage& image, const ImageBoundaryOptions& options);

  [[nodiscard]] BoundarySample sample(const Vec3& x, MaterialId a, MaterialId b) const override;

  /// The material whose smoothed share is largest at x, held at the voxels' centres as the field is.
  [[nodiscard]] MaterialId material_at(const Vec3& x) const;

  /// The label's surface moves outwards by so much against every other: one entry a material, mm. Corrects
  /// the loss of volume that all smooth surfaces have.
  void set_offsets(std::vector<double> offset_mm) { offset_mm_ = std::move(offset_mm); }
  [[nodiscard]] const std::vector<double>& offsets() const { return offset_mm_; }

 private:
  /// The smoothed and clamped field at the eight voxel centres from `low` on; false where a or b is in none
  /// of the 4x4x4 voxels round them, so that what the field says there of a third material means nothing.
  bool corners(const Index3& low, MaterialId a, MaterialId b, std::array<double, 8>& corner) const;
  [[nodiscard]] double clamped(double value, const std::array<signed char, 64>& side, int at) const;
  [[nodiscard]] BoundarySample far_sample(const Vec3& x, MaterialId a, MaterialId b) const;

  const LabelImage& image_;
  ImageBoundaryOptions options_;
  double voxel_mm_;  // geometric mean of the spacings
  std::vector<double> offset_mm_;
};

}  // namespace cbc3d
