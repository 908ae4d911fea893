#include "metrics/point_set_hausdorff.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>

namespace cbc3d::metrics {
namespace {

struct Cloud {
  const std::vector<Vec3>& points;
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
    return points[index][static_cast<int>(axis)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

// Largest distance of a point of `from` to its nearest point of `to`.
double directed_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  const Cloud cloud{to};
  const Tree tree(3, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(16));
  double largest = 0;
#pragma omp parallel for reduction(max : largest) schedule(static)
  for (const Vec3& p : from) {
    const double query[3] = {p.x, p.y, p.z};
    std::uint32_t index = 0;
    double squared = 0;
    tree.knnSearch(query, 1, &index, &squared);
    largest = std::max(largest, squared);
  }
  return std::sqrt(largest);
}

}  // namespace

std::optional<PointSetDistance> point_set_distance(const std::vector<Vec3>& image_points,
                                                   const std::vector<Vec3>& mesh_points) {
  if (image_points.empty() || mesh_points.empty()) {
    return std::nullopt;
  }
  return PointSetDistance{directed_distance(image_points, mesh_points),
                          directed_distance(mesh_points, image_points)};
}

}  // namespace cbc3d::metrics
