#include "metrics/image_boundary.hpp"

namespace cbc3d::metrics {
namespace {

void collect_slice(const LabelImage& image, int k, std::vector<MaterialBoundary>& found) {
  const Index3& size = image.frame.size;
  for (int j = 0; j < size[1]; ++j) {
    for (int i = 0; i < size[0]; ++i) {
      const MaterialId own = image.at(i, j, k);
      if (own == kBackground || !is_boundary_voxel(image, i, j, k)) {
        continue;
      }
      MaterialBoundary& boundary = found[own];
      boundary.voxel_centres.push_back(image.frame.local_centre(i, j, k));
      for (std::uint8_t axis = 0; axis < 3; ++axis) {
        for (const std::int8_t side : {-1, 1}) {
          const int at[3] = {i + (axis == 0 ? side : 0), j + (axis == 1 ? side : 0),
                             k + (axis == 2 ? side : 0)};
          if (const MaterialId other = image.at_or_background(at[0], at[1], at[2]); other != own) {
            boundary.faces.push_back({{i, j, k}, axis, side, other});
          }
        }
      }
    }
  }
}

}  // namespace

Vec3 centre_of(const VoxelFace& face, const ImageFrame& frame) {
  Vec3 centre = frame.local_centre(face.voxel[0], face.voxel[1], face.voxel[2]);
  centre[face.axis] += 0.5 * face.side * frame.spacing_mm[face.axis];
  return centre;
}

Box box_of(const VoxelFace& face, const ImageFrame& frame) {
  const Vec3 centre = centre_of(face, frame);
  Vec3 half = 0.5 * frame.spacing_mm;
  half[face.axis] = 0;
  return {centre - half, centre + half};
}

Vec3 voxel_face_areas_mm2(const ImageFrame& frame) {
  const Vec3& s = frame.spacing_mm;
  return {s.y * s.z, s.x * s.z, s.x * s.y};
}

std::vector<MaterialBoundary> image_boundaries(const LabelImage& image) {
  const auto slices = static_cast<std::size_t>(image.frame.size[2]);
  std::vector<std::vector<MaterialBoundary>> per_slice(slices);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < slices; ++k) {
    per_slice[k].resize(image.material_count());
    collect_slice(image, static_cast<int>(k), per_slice[k]);
  }
  std::vector<MaterialBoundary> total(image.material_count());
  for (auto& slice : per_slice) {
    for (std::size_t m = 0; m < total.size(); ++m) {
      auto& to = total[m];
      auto& from = slice[m];
      to.voxel_centres.insert(to.voxel_centres.end(), from.voxel_centres.begin(), from.voxel_centres.end());
      to.faces.insert(to.faces.end(), from.faces.begin(), from.faces.end());
    }
    slice.clear();
  }
  return total;
}

}  // namespace cbc3d::metrics
