#include "metrics/volumes.hpp"

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {

std::vector<double> label_volumes_mm3(const MeshView& view) {
  const std::vector<Vec3>& points = view.mesh().points;
  return ordered_sums<double>(
      view.cell_count(), view.labels().size(), [&](std::size_t c, std::vector<double>& volume) {
        const TetSplit split = split_into_tets(view.cell(c));
        for (int t = 0; t < split.count; ++t) {
          const auto& tet = split.tets[static_cast<std::size_t>(t)];
          volume[view.label_index(c)] +=
              six_volumes(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]) / 6;
        }
      });
}

}  // namespace cbc3d::metrics
