#include "cases/phantoms/model.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace cbc3d::cases {

Layer tube_layer(MaterialId material, Tubes tubes) {
  const auto shared = std::make_shared<const Tubes>(std::move(tubes));
  return {
      material,
      [shared, material = static_cast<PaintedVoxel>(material)](
          const ImageFrame& frame, int k, PaintedVoxel* slice) { shared->paint(frame, k, material, slice); },
      [shared](const Vec3& p) { return shared->distance_mm(p); }};
}

Layer predicate_layer(MaterialId material, std::function<bool(const Vec3& local_mm)> holds) {
  return {material,
          [holds = std::move(holds), material = static_cast<PaintedVoxel>(material)](
              const ImageFrame& frame, int k, PaintedVoxel* slice) {
            for (int j = 0; j < frame.size[1]; ++j) {
              for (int i = 0; i < frame.size[0]; ++i, ++slice) {
                if (holds(frame.local_centre(i, j, k))) {
                  *slice = material;
                }
              }
            }
          },
          nullptr};
}

void paint_slab(const PhantomModel& model, const ImageFrame& frame, int first, int last,
                PaintedVoxel* voxels) {
  const std::size_t slice_size =
      static_cast<std::size_t>(frame.size[0]) * static_cast<std::size_t>(frame.size[1]);
#pragma omp parallel for schedule(dynamic)
  for (int k = first; k < last; ++k) {
    PaintedVoxel* slice = voxels + static_cast<std::size_t>(k - first) * slice_size;
    std::fill(slice, slice + slice_size, PaintedVoxel{kBackground});
    for (const Layer& layer : model.layers) {
      layer.paint(frame, k, slice);
    }
  }
}

double signed_distance_mm(const PhantomModel& model, const Vec3& local_mm, MaterialId material) {
  double distance = std::numeric_limits<double>::infinity();
  bool begun = false;
  for (const Layer& layer : model.layers) {
    begun = begun || layer.material == material;
    if (!begun) {
      continue;
    }
    if (!layer.distance_mm) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double own = layer.distance_mm(local_mm);
    distance = layer.material == material ? std::min(distance, own) : std::max(distance, -own);
  }
  return distance;
}

double thinnest_radius_mm(const Vec3& spacing_mm) {
  return 0.25 * (spacing_mm.x + spacing_mm.y + spacing_mm.z);
}

}  // namespace cbc3d::cases
