#include "metrics/dice.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "mesher/core/voxel_rows.hpp"

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

VoxelRange voxel_range(std::span<const VertexId> nodes, const std::vector<Vec3>& points,
                       const ImageFrame& frame) {
  VoxelRange range{};
  for (int axis = 0; axis < 3; ++axis) {
    double low = points[nodes[0]][axis], high = low;
    for (const VertexId v : nodes) {
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

// Some slices of an image and what the mesh says of their voxels.
struct Slab {
  int begin, end;  // slices
  std::vector<MaterialId> voxels;
};

void fill_tet(const std::array<VertexId, 4>& tet, const std::vector<Vec3>& points, const ImageFrame& frame,
              MaterialId material, Slab& slab) {
  const std::array<HalfSpace, 4> halves{half_space({tet[1], tet[2], tet[3]}, tet[0], points),
                                        half_space({tet[0], tet[2], tet[3]}, tet[1], points),
                                        half_space({tet[0], tet[1], tet[3]}, tet[2], points),
                                        half_space({tet[0], tet[1], tet[2]}, tet[3], points)};
  const Vec3& s = frame.spacing_mm;
  const auto [low, high] = voxel_range(tet, points, frame);
  for (int k = std::max(low[2], slab.begin); k <= std::min(high[2], slab.end - 1); ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      bool entered = false;
      for (int i = low[0]; i <= high[0]; ++i) {
        const Vec3 p{(i + kNudge.x) * s.x, (j + kNudge.y) * s.y, (k + kNudge.z) * s.z};
        if (halves[0].at(p) > 0 && halves[1].at(p) > 0 && halves[2].at(p) > 0 && halves[3].at(p) > 0) {
          take(slab.voxels[frame.offset(i, j, k - slab.begin)], material);
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

// Rasterises a mesh slab by slab: memory is that of a slab, and a few bytes a cell.
class Rasteriser {
 public:
  Rasteriser(const MeshView& view, const LabelImage& image)
      : view_(view),
        frame_(image.frame),
        material_(materials_of_labels(view, image)),
        slices_(view.cell_count()) {
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t c = 0; c < slices_.size(); ++c) {
      const VoxelRange range = voxel_range(view.cell(c).nodes, view.local_points(), frame_);
      slices_[c] = {range.low[2], range.high[2]};
    }
  }

  void fill(Slab& slab) const {
    slab.voxels.assign(slice_voxels() * static_cast<std::size_t>(slab.end - slab.begin), kUncovered);
#pragma omp parallel for schedule(dynamic, 1024)
    for (std::size_t c = 0; c < slices_.size(); ++c) {
      const MaterialId own = material_[view_.label_index(c)];
      if (own == kUncovered || slices_[c][1] < slab.begin || slices_[c][0] >= slab.end) {
        continue;
      }
      const TetSplit split = split_into_tets(view_.cell(c));
      for (int t = 0; t < split.count; ++t) {
        fill_tet(split.tets[static_cast<std::size_t>(t)], view_.local_points(), frame_, own, slab);
      }
    }
  }

  [[nodiscard]] std::size_t slice_voxels() const {
    return frame_.offset(0, 0, 1);
  }

 private:
  const MeshView& view_;
  const ImageFrame& frame_;
  std::vector<MaterialId> material_;
  std::vector<std::array<int, 2>> slices_;  // first and last of every cell
};

// Adds the voxels of a slab to the counts of their materials.
void count_slab(const Slab& slab, const LabelImage& image, std::vector<Overlap>& overlaps) {
  const int size = image.frame.size[0];
  const std::size_t first_row = image.frame.offset(0, 0, slab.begin) / static_cast<std::size_t>(size);
  const std::size_t rows = slab.voxels.size() / static_cast<std::size_t>(size);
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel
    {
      std::vector<Overlap> mine(overlaps.size());
#pragma omp for nowait
      for (std::size_t r = 0; r < rows; ++r) {
        const auto* in_image = voxels + (first_row + r) * static_cast<std::size_t>(size);
        const MaterialId* in_mesh = slab.voxels.data() + r * static_cast<std::size_t>(size);
        for (int i = 0, end = 0; i < size; i = end) {
          end = end_of_run(in_mesh, i, end_of_run(in_image, i, size));
          if (in_mesh[i] != kUncovered) {
            mine[in_mesh[i]].mesh += end - i;
          }
          if (in_image[i] != kBackground) {
            mine[in_image[i]].image += end - i;
            mine[in_image[i]].both += in_mesh[i] == in_image[i] ? end - i : 0;
          }
        }
      }
#pragma omp critical(cbc3d_count_slab)
      for (std::size_t m = 0; m < overlaps.size(); ++m) {
        overlaps[m].both += mine[m].both;
        overlaps[m].mesh += mine[m].mesh;
        overlaps[m].image += mine[m].image;
      }
    }
  });
}

}  // namespace

std::vector<MaterialId> rasterise(const MeshView& view, const LabelImage& image) {
  Slab all{0, image.frame.size[2], {}};
  Rasteriser(view, image).fill(all);
  return std::move(all.voxels);
}

std::vector<Overlap> count_overlaps(const MeshView& view, const LabelImage& image, std::size_t slab_voxels) {
  const Rasteriser rasteriser(view, image);
  const auto step = static_cast<int>(
      std::clamp<std::size_t>(slab_voxels / std::max<std::size_t>(1, rasteriser.slice_voxels()), 1,
                              static_cast<std::size_t>(image.frame.size[2])));
  std::vector<Overlap> overlaps(image.material_count());
  Slab slab{0, 0, {}};
  while (slab.end < image.frame.size[2]) {
    slab.begin = slab.end;
    slab.end = std::min(slab.begin + step, image.frame.size[2]);
    rasteriser.fill(slab);
    count_slab(slab, image, overlaps);
  }
  return overlaps;
}

}  // namespace cbc3d::metrics
