#include "baselines/podm/surface_oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cbc3d::baselines::podm {

SurfaceOracle::SurfaceOracle(const LabelImage& image, bool smooth)
    : image_(image), boundary_(image), step_mm_(0.5 * image.frame.spacing_mm.min_coeff()) {
  if (smooth) smooth_.emplace(image);
}

MaterialId SurfaceOracle::material_at(const Vec3& place) const {
  const MaterialId own = image_.at_local(place);
  if (!smooth_) return own;
  // The smooth boundaries are within a voxel of the voxels' own.
  if (distance_bound_mm(place) > image_.frame.voxel_diagonal_mm()) return own;
  return smooth_->material_at(place);
}

// The voxel of a place; for one beyond the labels' box the nearest in it.
Index3 SurfaceOracle::voxel_of(const Vec3& place) const {
  Index3 at{};
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    const double index = std::floor(place[axis] / image_.frame.spacing_mm[axis] + 0.5);
    at[a] = static_cast<int>(std::clamp(index, static_cast<double>(boundary_.first()[a]),
                                        static_cast<double>(boundary_.last()[a])));
  }
  return at;
}

double SurfaceOracle::distance_bound_mm(const Vec3& place) const {
  const Index3 voxel = voxel_of(place);
  const Vec3 own = centre(voxel);
  // A face is within half a diagonal of a boundary voxel's centre, and the smooth surface as far from that.
  const double slack = (smooth_ ? 1.0 : 0.5) * image_.frame.voxel_diagonal_mm();
  const double way = (place - own).norm();
  // Beyond the box the surface is as far away as the box, at least.
  return std::max((centre(boundary_.nearest(voxel)) - own).norm() - way, way - slack) - slack;
}

// The nearest place on the faces of a boundary voxel. On the face its coordinate is the same number however
// it was found, so that samples of a flat side are exactly coplanar and no flat tets come of them.
SurfaceOracle::FacePoint SurfaceOracle::nearest_on_faces(const Vec3& place, const Index3& voxel) const {
  const Vec3 own = centre(voxel);
  const Vec3& h = image_.frame.spacing_mm;
  const std::uint8_t faces = boundary_.faces(voxel);
  FacePoint best;
  double best_mm2 = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < 6; ++f) {
    if ((faces >> f & 1U) == 0) continue;
    const int axis = static_cast<int>(f / 2);
    Vec3 q;
    for (int a = 0; a < 3; ++a) q[a] = std::clamp(place[a], own[a] - 0.5 * h[a], own[a] + 0.5 * h[a]);
    const int lower = voxel[f / 2] - (f % 2 == 0 ? 1 : 0);
    q[axis] = (lower + 0.5) * h[axis];
    const double mm2 = (q - place).squared_norm();
    if (mm2 >= best_mm2) continue;
    best_mm2 = mm2;
    const Index3& s = kFaceSteps[f];
    best = {q, own, own + Vec3{s[0] * h.x, s[1] * h.y, s[2] * h.z}};
  }
  return best;
}

std::optional<Vec3> SurfaceOracle::nearest(const Vec3& place) const {
  const FacePoint face = nearest_on_faces(place, boundary_.nearest(voxel_of(place)));
  if (!smooth_) return face.place;
  return smooth_near(place, face);
}

// Where the way from a place to the nearest face, and a voxel on, crosses the smooth surface; otherwise where
// the way between the centres of the face's voxels does, at which materials are the voxels' own.
std::optional<Vec3> SurfaceOracle::smooth_near(const Vec3& place, const FacePoint& face) const {
  const double reach = image_.frame.voxel_diagonal_mm();
  const Vec3 way = face.place - place;
  const double length = way.norm();
  const Vec3 unit = length > 1e-9 * reach ? way / length : (face.outside - face.inside).normalized();
  const Vec3 from = place + std::max(0.0, length - reach) * unit;
  if (const auto found = first_change(from, place + (length + reach) * unit, step_mm_)) return found;
  return first_change(face.inside, face.outside, 0.5 * step_mm_);
}

std::optional<Vec3> SurfaceOracle::first_change(const Vec3& from, const Vec3& to, double step_mm) const {
  const Vec3 way = to - from;
  const double length = way.norm();
  if (!(length > 0)) return std::nullopt;
  const MaterialId own = material_at(from);
  Vec3 before = from;
  for (double at = 0; at < length;) {
    // Where the surface is far away the steps are as long as the way to it.
    at = std::min(length, at + std::max(step_mm, 0.99 * distance_bound_mm(before)));
    const Vec3 next = at < length ? from + (at / length) * way : to;
    if (material_at(next) != own) return bisect(before, next);
    before = next;
  }
  return std::nullopt;
}

Vec3 SurfaceOracle::bisect(Vec3 own, Vec3 other) const {
  const MaterialId material = material_at(own);
  // The voxels' faces are found exactly in the end; the smooth surface to some 1e-4 of a voxel.
  const int halvings = smooth_ ? 12 : 24;
  for (int n = 0; n < halvings; ++n) {
    const Vec3 middle = 0.5 * (own + other);
    (material_at(middle) == material ? own : other) = middle;
  }
  return smooth_ ? 0.5 * (own + other) : onto_face(0.5 * (own + other));
}

// A place within rounding of a voxel's face gets exactly its coordinate.
Vec3 SurfaceOracle::onto_face(const Vec3& place) const {
  return nearest_on_faces(place, boundary_.nearest(voxel_of(place))).place;
}

std::optional<Vec3> SurfaceOracle::crossing(const Vec3& from, const Vec3& to) const {
  // The part of the segment within a voxel of the image; beyond it nothing changes.
  double first = 0, last = 1;
  const Vec3& h = image_.frame.spacing_mm;
  for (int a = 0; a < 3; ++a) {
    const double low = -h[a], high = image_.frame.size[static_cast<std::size_t>(a)] * h[a];
    const double way = to[a] - from[a];
    if (way == 0) {
      if (from[a] < low || from[a] > high) return std::nullopt;
      continue;
    }
    const double enters = ((way > 0 ? low : high) - from[a]) / way;
    const double leaves = ((way > 0 ? high : low) - from[a]) / way;
    first = std::max(first, enters);
    last = std::min(last, leaves);
  }
  if (!(first < last)) return std::nullopt;
  return first_change(from + first * (to - from), from + last * (to - from), step_mm_);
}

}  // namespace cbc3d::baselines::podm
