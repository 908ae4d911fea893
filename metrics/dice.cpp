#include "metrics/dice.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

// Far below any voxel, far above rounding; no small whole-number plane holds this direction.
constexpr Vec3 kNudge{1.0e-6, 0.6180339887e-6, 0.3819660113e-6};

// Positive inside the tet. Computed from the facet's vertices in ascending order, then signed: both tets at a
// facet get opposite values, so that a centre is never in both and never in neither.
struct HalfSpace {
  Vec3 normal, origin;

  [[nodiscard]] double at(const Vec3& p) const { return normal.dot(p - origin); }
};

HalfSpace half_space(std::array<VertexId, 3> face, VertexId opposite, const std::vector<Vec3>& points) {
  std::sort(face.begin(), face.end());
  const Vec3& origin = points[face[0]];
  HalfSpace half{(points[face[1]] - origin).cross(points[face[2]] - origin), origin};
  if (half.at(points[opposite]) < 0) {
    half.normal = -half.normal;
  }
  return half;
}

struct VoxelRange {
  Index3 low, high;  // inclusive
};

VoxelRange voxel_range(const std::array<VertexId, 4>& tet, const std::vector<Vec3>& points,
                       const ImageFrame& frame) {
  VoxelRange range{};
  for (int axis = 0; axis < 3; ++axis) {
    double low = points[tet[0]][axis], high = low;
    for (const VertexId v : tet) {
      low = std::min(low, points[v][axis]);
      high = std::max(high, points[v][axis]);
    }
    const auto a = static_cast<std::size_t>(axis);
    const double last = frame.size[a] - 1, spacing = frame.spacing_mm[axis];
    // The nudge moves centres up by less than a voxel; clamped before the cast, so a far vertex is harmless.
    range.low[a] = static_cast<int>(std::clamp(std::ceil(low / spacing - 2e-6), 0.0, last + 1));
    range.high[a] = static_cast<int>(std::clamp(std::floor(high / spacing), -1.0, last));
  }
  return range;
}

void take(MaterialId& voxel, MaterialId material) {
  std::atomic_ref shared(voxel);
  MaterialId current = shared.load(std::memory_order_relaxed);
  while (material < current && !shared.compare_exchange_weak(current, material, std::memory_order_relaxed)) {
  }
}

void fill_tet(const std::array<VertexId, 4>& tet, const std::vector<Vec3>& points, const ImageFrame& frame,
              MaterialId material, std::vector<MaterialId>& voxels) {
  const std::array<HalfSpace, 4> halves{half_space({tet[1], tet[2], tet[3]}, tet[0], points),
                                        half_space({tet[0], tet[2], tet[3]}, tet[1], points),
                                        half_space({tet[0], tet[1], tet[3]}, tet[2], points),
                                        half_space({tet[0], tet[1], tet[2]}, tet[3], points)};
  const Vec3& s = frame.spacing_mm;
  const auto [low, high] = voxel_range(tet, points, frame);
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      bool entered = false;
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vec3 p{(i + kNudge.x) * s.x, (j + kNudge.y) * s.y, (k + kNudge.z) * s.z};
        if (halves[0].at(p) > 0 && halves[1].at(p) > 0 && halves[2].at(p) > 0 && halves[3].at(p) > 0) {
          take(voxels[frame.offset(i, j, k)], material);
          entered = true;
        } else if (entered) {
          break;  // a tet is convex
        }
      }
    }
  }
}

// Material of every label of the mesh; kUncovered where the image has no such label.
std::vector<MaterialId> materials_of_labels(const MeshView& view, const LabelImage& image) {
  std::vector<MaterialId> material(view.labels().size(), kUncovered);
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    if (const auto index = view.find_label(image.labels[m])) {
      material[*index] = static_cast<MaterialId>(m);
    }
  }
  return material;
}

}  // namespace

std::vector<MaterialId> rasterise(const MeshView& view, const LabelImage& image) {
  const std::vector<MaterialId> material = materials_of_labels(view, image);
  std::vector<MaterialId> voxels(image.voxels.size(), kUncovered);
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    const MaterialId own = material[view.label_index(c)];
    if (own == kUncovered) {
      continue;
    }
    const TetSplit split = split_into_tets(view.cell(c));
    for (int t = 0; t < split.count; ++t) {
      fill_tet(split.tets[static_cast<std::size_t>(t)], view.local_points(), image.frame, own, voxels);
    }
  }
  return voxels;
}

std::vector<Overlap> count_overlaps(const std::vector<MaterialId>& rasterised, const LabelImage& image) {
  const std::size_t materials = image.material_count();
  const auto counts = ordered_sums<std::int64_t>(
      rasterised.size(), 3 * materials, [&](std::size_t v, std::vector<std::int64_t>& count) {
        const MaterialId in_mesh = rasterised[v], in_image = image.voxels[v];
        if (in_mesh != kUncovered) {
          ++count[3 * in_mesh + 1];
        }
        if (in_image != kBackground) {
          ++count[3 * in_image + 2];
          count[3 * in_image] += in_mesh == in_image ? 1 : 0;
        }
      });
  std::vector<Overlap> overlaps(materials);
  for (std::size_t m = 0; m < materials; ++m) {
    overlaps[m] = {counts[3 * m], counts[3 * m + 1], counts[3 * m + 2]};
  }
  return overlaps;
}

}  // namespace cbc3d::metrics
