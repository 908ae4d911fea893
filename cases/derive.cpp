#include "cases/derive.hpp"

#include <algorithm>
#include <map>
#include <vector>

namespace cbc3d::cases {
namespace {

/// Calls visit(offset) for the face neighbours of a voxel; returns whether the voxel lies at the border.
template <class Visit>
bool for_each_face_neighbour(const ImageFrame& frame, std::size_t voxel, const Visit& visit) {
  const Index3 index = frame.index_of(voxel);
  const std::size_t row = static_cast<std::size_t>(frame.size[0]);
  const std::array<std::size_t, 3> stride{1, row, row * static_cast<std::size_t>(frame.size[1])};
  bool at_border = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (index[axis] > 0) {
      visit(voxel - stride[axis]);
    }
    if (index[axis] < frame.size[axis] - 1) {
      visit(voxel + stride[axis]);
    }
    at_border = at_border || index[axis] == 0 || index[axis] == frame.size[axis] - 1;
  }
  return at_border;
}

struct BackgroundRegion {
  std::vector<std::size_t> voxels;
  std::map<MaterialId, std::size_t> faces;  // of labelled voxels around it
  bool at_border = false;
};

/// The background region of `start`; marks its voxels as seen.
BackgroundRegion grow_region(const LabelImage& image, std::size_t start, std::vector<bool>& seen) {
  BackgroundRegion region;
  region.voxels.push_back(start);
  seen[start] = true;
  for (std::size_t next = 0; next < region.voxels.size(); ++next) {
    const auto visit = [&](std::size_t neighbour) {
      if (image.voxels[neighbour] != kBackground) {
        ++region.faces[image.voxels[neighbour]];
      } else if (!seen[neighbour]) {
        seen[neighbour] = true;
        region.voxels.push_back(neighbour);
      }
    };
    if (for_each_face_neighbour(image.frame, region.voxels[next], visit)) {
      region.at_border = true;
    }
  }
  return region;
}

/// Materials are in the order of their labels, so the first of the most frequent has the smallest label.
MaterialId most_frequent(const std::map<MaterialId, std::size_t>& faces) {
  return std::max_element(faces.begin(), faces.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

}  // namespace

std::size_t fill_holes(LabelImage& image) {
  std::vector<bool> seen(image.voxels.size());
  std::vector<std::pair<BackgroundRegion, MaterialId>> holes;
  for (std::size_t voxel = 0; voxel < image.voxels.size(); ++voxel) {
    if (image.voxels[voxel] == kBackground && !seen[voxel]) {
      BackgroundRegion region = grow_region(image, voxel, seen);
      if (!region.at_border) {
        const MaterialId material = most_frequent(region.faces);
        holes.emplace_back(std::move(region), material);
      }
    }
  }
  std::size_t filled = 0;
  for (const auto& [region, material] : holes) {
    for (const std::size_t voxel : region.voxels) {
      image.voxels[voxel] = material;
    }
    filled += region.voxels.size();
  }
  return filled;
}

LabelImage repeated(const LabelImage& image, const Index3& copies) {
  const Index3& size = image.frame.size;
  LabelImage result;
  result.frame = image.frame;
  result.labels = image.labels;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.frame.size[axis] = size[axis] * copies[axis];
  }
  result.voxels.resize(result.frame.voxel_count());
  for (int k = 0; k < result.frame.size[2]; ++k) {
    for (int j = 0; j < result.frame.size[1]; ++j) {
      const std::size_t from = image.frame.offset(0, j % size[1], k % size[2]);
      const std::size_t to = result.frame.offset(0, j, k);
      for (int i = 0; i < result.frame.size[0]; ++i) {
        result.voxels[to + static_cast<std::size_t>(i)] =
            image.voxels[from + static_cast<std::size_t>(i % size[0])];
      }
    }
  }
  return result;
}

}  // namespace cbc3d::cases
