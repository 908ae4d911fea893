// The feature transform of a label image: for every voxel the nearest boundary voxel (Maurer, Qi and Raghavan
// 2003; lower envelopes of parabolas as in Felzenszwalb and Huttenlocher 2012), exact in mm, in linear time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines::podm {

/// The six neighbours of a voxel across its faces: -x, +x, -y, +y, -z, +z.
inline constexpr std::array<Index3, 6> kFaceSteps{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Nearest boundary voxels by the distance of centres. A boundary voxel is one with a face neighbour of
/// another material, be it labelled or background; beyond the image all is background.
class NearestBoundary {
 public:
  /// Takes 7 bytes per voxel of the labels' box. Throws InputError for an image of more than 65,534 voxels
  /// along an axis.
  explicit NearestBoundary(const LabelImage& image);

  /// False for an image without a labelled voxel.
  [[nodiscard]] bool has_boundary() const { return has_boundary_; }
  /// The box of the labelled voxels and one voxel more on each side, within the image: first and last voxel.
  [[nodiscard]] const Index3& first() const { return first_; }
  [[nodiscard]] const Index3& last() const { return last_; }
  /// The boundary voxel nearest to a voxel in the box; there must be one.
  [[nodiscard]] Index3 nearest(const Index3& voxel) const {
    const auto& of = features_[offset(voxel)];
    return {of[0] + first_[0], of[1] + first_[1], of[2] + first_[2]};
  }
  /// The faces of a voxel in the box across which another material lies: bit f for kFaceSteps[f].
  [[nodiscard]] std::uint8_t faces(const Index3& voxel) const { return faces_[offset(voxel)]; }

 private:
  using Feature = std::array<std::uint16_t, 3>;
  static constexpr std::uint16_t kNone = 0xFFFF;
  class Envelope;

  // Of a voxel of the image in the arrays.
  [[nodiscard]] std::size_t offset(const Index3& v) const {
    return frame_.offset(v[0] - first_[0], v[1] - first_[1], v[2] - first_[2]);
  }
  void find_box(const LabelImage& image);
  void find_faces(const LabelImage& image);
  void sweep_rows();
  void sweep_axis(std::size_t axis);
  void sweep_line(Envelope& envelope, Feature* line, Index3 at, std::size_t axis) const;
  [[nodiscard]] double height(const Feature& feature, const Index3& at, std::size_t axis) const;

  ImageFrame frame_;  // of the box
  Index3 first_{0, 0, 0}, last_{-1, -1, -1};
  std::vector<std::uint8_t> faces_;
  std::vector<Feature> features_;
  bool has_boundary_ = false;
};

}  // namespace cbc3d::baselines::podm
