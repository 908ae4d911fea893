// The indicator functions of a label image: each label's mask blurred by a Gaussian, without storing one.
//
// The blurred masks sum to 1 everywhere, so that any number of materials meet without gaps, and a value needs
// only the voxels within kReach standard deviations: memory does not grow with the number of labels. The
// original takes the signed distance of each blurred mask's middle level instead; both put the boundary of
// two thick labels at the same place.
#pragma once

#include <vector>

#include "baselines/cleaver/indicators.hpp"
#include "baselines/cleaver/uniform_bricks.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines::cleaver {

class ImageIndicators final : public Indicators {
 public:
  /// `blur_voxels` are the Gaussian's standard deviations along the axes, in voxels, in (0, kMostBlur]. The
  /// image must outlive this.
  ImageIndicators(const LabelImage& image, const Vec3& blur_voxels);

  [[nodiscard]] MaterialId material_at(const Vec3& place) const override;
  [[nodiscard]] double crossing(const Vec3& from, const Vec3& to, MaterialId a, MaterialId b) const override;
  [[nodiscard]] bool is_outside(const Vec3& place) const override;

  /// True only if no label has a voxel near the box from `low` to `high`, so that all of it is background.
  [[nodiscard]] bool is_surely_background(const Vec3& low, const Vec3& high) const;

  /// Labels that the blur would erase wherever it was looked: their indicators are their voxels' own.
  [[nodiscard]] const std::vector<MaterialId>& sharp_materials() const { return sharp_; }
  /// The box of the image, mm: the faces of its outermost voxels.
  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] const Vec3& high() const { return high_; }

  static constexpr double kReach = 2.5;    ///< of the Gaussian, standard deviations
  static constexpr double kMostBlur = 16;  ///< voxels

 private:
  struct Share {
    MaterialId material;
    double value;
  };
  using Shares = std::vector<Share>;

  void find_sharp_materials();
  [[nodiscard]] const Shares& shares_at(const Vec3& place) const;
  [[nodiscard]] double mask_at(const Vec3& voxel, MaterialId material) const;
  void sharpen(const Vec3& voxel, Shares& shares) const;
  [[nodiscard]] double lead(const Vec3& place, MaterialId a, MaterialId b) const;
  [[nodiscard]] double crossing_inside(const Vec3& from, const Vec3& to, MaterialId a, MaterialId b) const;
  [[nodiscard]] double leaving_box(const Vec3& from, const Vec3& to) const;

  const LabelImage& image_;
  Vec3 blur_;   // standard deviations, voxels
  Vec3 reach_;  // voxels
  UniformBricks bricks_;
  Vec3 low_, high_;
  double tolerance_ = 0;  // mm within which a place is on the box and not beyond it
  std::vector<MaterialId> sharp_;
  std::vector<char> is_sharp_;
};

}  // namespace cbc3d::baselines::cleaver
