// What the refinement asks of the image: the material at a place, the nearest place of the surface, and where
// a segment crosses it. The surface is all places where the material changes; beyond the image all is
// background. Places are in local mm.
#pragma once

#include <optional>

#include "baselines/podm/nearest_boundary.hpp"
#include "mesher/domain/image_domain.hpp"

namespace cbc3d::baselines::podm {

class SurfaceOracle {
 public:
  /// `smooth` takes the smoothed boundaries of ImageDomain; otherwise the surface is the voxels' faces. The
  /// image must outlive this.
  SurfaceOracle(const LabelImage& image, bool smooth);

  /// False for an image without a labelled voxel.
  [[nodiscard]] bool has_surface() const { return boundary_.has_boundary(); }
  [[nodiscard]] MaterialId material_at(const Vec3& place) const;
  /// A place of the surface near the nearest one: of the voxels' faces the nearest on the faces of the
  /// boundary voxel whose centre is nearest to the place's voxel, of the smooth surface where the way there
  /// crosses it. None where the smooth surface has nothing of a voxel's faces.
  [[nodiscard]] std::optional<Vec3> nearest(const Vec3& place) const;
  /// No place of the surface is nearer than this.
  [[nodiscard]] double distance_bound_mm(const Vec3& place) const;
  /// The place nearest to `from` at which the segment leaves the material of `from`, found in steps of half
  /// the least spacing and by bisection; none where none of the steps does.
  [[nodiscard]] std::optional<Vec3> crossing(const Vec3& from, const Vec3& to) const;

 private:
  struct FacePoint {
    Vec3 place;
    Vec3 inside, outside;  // centres of the voxels on both sides of the face
  };

  [[nodiscard]] Index3 voxel_of(const Vec3& place) const;
  [[nodiscard]] Vec3 centre(const Index3& v) const { return image_.frame.local_centre(v[0], v[1], v[2]); }
  [[nodiscard]] FacePoint nearest_on_faces(const Vec3& place, const Index3& voxel) const;
  [[nodiscard]] std::optional<Vec3> smooth_near(const Vec3& place, const FacePoint& face) const;
  [[nodiscard]] std::optional<Vec3> first_change(const Vec3& from, const Vec3& to, double step_mm) const;
  [[nodiscard]] Vec3 bisect(Vec3 own, Vec3 other) const;
  [[nodiscard]] Vec3 onto_face(const Vec3& place) const;

  const LabelImage& image_;
  NearestBoundary boundary_;
  std::optional<ImageDomain> smooth_;
  double step_mm_;
};

}  // namespace cbc3d::baselines::podm
