#include "metrics/image_boundary.hpp"

#include <algorithm>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d::metrics {
namespace {

// The boundary voxels of a slice and their faces towards other materials, in memory order.
struct SliceBoundary {
  struct Voxel {
    std::int32_t i, j;
    MaterialId material;
    std::uint8_t faces;  // number of the faces that are this voxel's
  };
  std::vector<Voxel> voxels;
  std::vector<VoxelFace> faces;
};

void collect_voxel(const LabelImage& image, const Index3& at, SliceBoundary& found) {
  const MaterialId own = image.at(at[0], at[1], at[2]);
  const std::size_t before = found.faces.size();
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    for (const std::int8_t side : {-1, 1}) {
      Index3 next = at;
      next[axis] += side;
      if (const MaterialId other = image.at_or_background(next[0], next[1], next[2]); other != own) {
        found.faces.push_back({at, axis, side, other});
      }
    }
  }
  found.voxels.push_back({at[0], at[1], own, static_cast<std::uint8_t>(found.faces.size() - before)});
}

SliceBoundary collect_slice(const LabelImage& image, const BoundaryRows& rows, int k) {
  SliceBoundary found;
  std::vector<int> in_row;
  for (int j = 0; j < image.frame.size[1]; ++j) {
    in_row.clear();
    rows.find(j, k, in_row);
    for (const int i : in_row) {
      collect_voxel(image, {i, j, k}, found);
    }
  }
  return found;
}

// Room for what the slices hold, so that nothing is copied while it grows.
std::vector<MaterialBoundary> with_room(std::size_t materials, const std::vector<SliceBoundary>& slices) {
  std::vector<std::size_t> voxels(materials, 0), faces(materials, 0);
  for (const SliceBoundary& slice : slices) {
    for (const SliceBoundary::Voxel& voxel : slice.voxels) {
      ++voxels[voxel.material];
      faces[voxel.material] += voxel.faces;
    }
  }
  std::vector<MaterialBoundary> total(materials);
  for (std::size_t m = 0; m < materials; ++m) {
    total[m].voxel_centres.reserve(voxels[m]);
    total[m].faces.reserve(faces[m]);
  }
  return total;
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

VoxelBox box_of(const MaterialBoundary& boundary) {
  if (boundary.faces.empty()) {
    return {};
  }
  VoxelBox box{boundary.faces[0].voxel, boundary.faces[0].voxel};
  for (const VoxelFace& face : boundary.faces) {
    for (std::size_t a = 0; a < 3; ++a) {
      box.low[a] = std::min(box.low[a], face.voxel[a]);
      box.high[a] = std::max(box.high[a], face.voxel[a]);
    }
  }
  return box;
}

Vec3 voxel_face_areas_mm2(const ImageFrame& frame) {
  const Vec3& s = frame.spacing_mm;
  return {s.y * s.z, s.x * s.z, s.x * s.y};
}

std::vector<MaterialBoundary> image_boundaries(const LabelImage& image) {
  std::vector<SliceBoundary> slices(static_cast<std::size_t>(image.frame.size[2]));
  const BoundaryRows rows(image);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < slices.size(); ++k) {
    slices[k] = collect_slice(image, rows, static_cast<int>(k));
  }
  std::vector<MaterialBoundary> total = with_room(image.material_count(), slices);
  for (std::size_t k = 0; k < slices.size(); ++k) {
    auto face = slices[k].faces.begin();
    for (const auto& [i, j, material, faces] : slices[k].voxels) {
      MaterialBoundary& to = total[material];
      to.voxel_centres.push_back(image.frame.local_centre(i, j, static_cast<int>(k)));
      to.faces.insert(to.faces.end(), face, face + faces);
      face += faces;
    }
    slices[k] = {};
  }
  return total;
}

}  // namespace cbc3d::metrics
