#include "mesher/core/mesh_coordinates.hpp"

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

template <typename Map>
void move_points(std::vector<Vec3>& points, const Map& map) {
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < points.size(); ++v) {
    points[v] = map(points[v]);
  }
}

/// A half turn about z, the same in both directions.
void turn(std::vector<Vec3>& points) {
  move_points(points, [](const Vec3& p) { return Vec3{-p.x, -p.y, p.z}; });
}

void require_known(const std::string& coordinates, const ImageFrame* frame) {
  if (coordinates != "LPS" && coordinates != "RAS" && coordinates != "voxel") {
    throw InputError("coordinates " + coordinates + " are not known; give lps, ras or voxel");
  }
  if (coordinates == "voxel" && frame == nullptr) {
    throw InputError(
        "coordinates voxel need the image that the indices are of; name it, or choose lps or ras");
  }
}

}  // namespace

bool from_lps(std::vector<Vec3>& points, const std::string& coordinates, const ImageFrame* frame) {
  require_known(coordinates, frame);
  if (coordinates == "RAS") {
    turn(points);
  } else if (coordinates == "voxel") {
    move_points(points, [frame](const Vec3& p) {
      const Vec3 local = frame->to_local(p);
      const Vec3& s = frame->spacing_mm;
      return Vec3{local.x / s.x, local.y / s.y, local.z / s.z};
    });
    return frame->left_handed();
  }
  return false;
}

void from_lps(Mesh& mesh, const std::string& coordinates, const ImageFrame* frame) {
  if (from_lps(mesh.points, coordinates, frame)) {
    flip_orientation(mesh);
  }
}

void to_lps(Mesh& mesh, const std::string& coordinates, const ImageFrame* frame) {
  require_known(coordinates, frame);
  if (coordinates == "RAS") {
    turn(mesh.points);
  } else if (coordinates == "voxel") {
    move_points(mesh.points, [frame](const Vec3& p) {
      const Vec3& s = frame->spacing_mm;
      return frame->to_physical({p.x * s.x, p.y * s.y, p.z * s.z});
    });
    if (frame->left_handed()) {
      flip_orientation(mesh);
    }
  }
}

}  // namespace cbc3d
