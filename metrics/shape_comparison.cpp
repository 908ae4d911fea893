#include "metrics/shape_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "metrics/image_boundary.hpp"
#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

// Voxel faces as two triangles each, in physical space, outward.
std::vector<OutwardTriangle> outward_triangles(const std::vector<VoxelFace>& faces, const ImageFrame& frame) {
  std::vector<OutwardTriangle> triangles;
  triangles.reserve(2 * faces.size());
  for (const VoxelFace& face : faces) {
    const Box box = box_of(face, frame);
    const int u = (face.axis + 1) % 3;
    std::array<Vec3, 4> ring{box.low, box.low, box.high, box.high};
    ring[1][u] = box.high[u];
    ring[3][u] = box.low[u];
    // The ring runs counter-clockwise seen from the high side, and clockwise in a left-handed frame.
    if ((face.side < 0) != frame.left_handed()) {
      std::swap(ring[1], ring[3]);
    }
    std::for_each(ring.begin(), ring.end(), [&](Vec3& p) { p = frame.to_physical(p); });
    triangles.push_back({ring[0], ring[1], ring[2]});
    triangles.push_back({ring[0], ring[2], ring[3]});
  }
  return triangles;
}

// Drops what lies within a voxel of the image's border.
void keep_inner(std::vector<OutwardTriangle>& triangles, const ImageFrame& frame) {
  const Vec3& s = frame.spacing_mm;
  const Vec3 low = 0.5 * s;
  const Vec3 high = frame.local_centre(frame.size[0] - 1, frame.size[1] - 1, frame.size[2] - 1) - 0.5 * s;
  std::erase_if(triangles, [&](const OutwardTriangle& t) {
    const Vec3 middle = frame.to_local((t[0] + t[1] + t[2]) / 3);
    return middle.x < low.x || middle.y < low.y || middle.z < low.z || middle.x > high.x ||
           middle.y > high.y || middle.z > high.z;
  });
}

double area_of(const std::vector<OutwardTriangle>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

// A signed distance may take long; more triangles than this, picked evenly, change no mean by much.
constexpr std::size_t kMostTriangles = 30000;

ShapeDeviation inner_deviation(std::vector<OutwardTriangle> triangles, const ImageFrame& frame,
                               const SignedDistance& shape, Label label) {
  constexpr double kSmall = 1.5;  // voxels: triangles of voxel faces are
  keep_inner(triangles, frame);
  const double area = area_of(triangles);
  const std::size_t count = triangles.size();
  for (std::size_t n = 0; count > kMostTriangles && n < kMostTriangles; ++n) {
    triangles[n] = triangles[n * count / kMostTriangles];
  }
  triangles.resize(std::min(count, kMostTriangles));
  ShapeDeviation result = shape_deviation(triangles, shape, {1e-3, kSmall * frame.spacing_mm.max_coeff()});
  if (result.mesh_area_mm2 > 0) {
    result.shape_area_mm2 *= area / result.mesh_area_mm2;
    result.mesh_area_mm2 = area;
  }
  result.label = label;
  return result;
}

bool is_known(const ShapeDeviation& deviation) {
  return deviation.mesh_area_mm2 > 0 && std::isfinite(deviation.mean_distance_mm) &&
         std::isfinite(deviation.shape_area_mm2) && std::isfinite(deviation.mean_normal_deviation_deg);
}

// Over several labels.
ShapeDeviation joint(const std::vector<ShapePair>& labels, ShapeDeviation ShapePair::*side) {
  ShapeDeviation all;
  for (const ShapePair& pair : labels) {
    const ShapeDeviation& one = pair.*side;
    all.mesh_area_mm2 += one.mesh_area_mm2;
    all.shape_area_mm2 += one.shape_area_mm2;
    all.mean_normal_deviation_deg += one.mesh_area_mm2 * one.mean_normal_deviation_deg;
    all.mean_distance_mm += one.mesh_area_mm2 * one.mean_distance_mm;
    all.max_normal_deviation_deg = std::max(all.max_normal_deviation_deg, one.max_normal_deviation_deg);
    all.max_distance_mm = std::max(all.max_distance_mm, one.max_distance_mm);
  }
  all.mean_normal_deviation_deg /= all.mesh_area_mm2;
  all.mean_distance_mm /= all.mesh_area_mm2;
  all.area_excess_percent = 100 * (all.mesh_area_mm2 / all.shape_area_mm2 - 1);
  return all;
}

json figures_of(const ShapeDeviation& deviation) {
  const bool known = is_known(deviation);
  const auto figure = [known](double value) {
    return number_or_null(known ? std::optional(value) : std::nullopt);
  };
  return {{"normal_deviation_deg", figure(deviation.mean_normal_deviation_deg)},
          {"max_normal_deviation_deg", figure(deviation.max_normal_deviation_deg)},
          {"area_excess_percent", figure(deviation.area_excess_percent)},
          {"mean_distance_mm", figure(deviation.mean_distance_mm)},
          {"max_distance_mm", figure(deviation.max_distance_mm)}};
}

}  // namespace

std::vector<ShapePair> compare_with_shapes(const MeshView& view, const LabelImage& image,
                                           const Surface& surface, const LabelShapes& shapes) {
  const std::vector<MaterialBoundary> boundaries = image_boundaries(image);
  std::vector<ShapePair> result;
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    const Label label = image.labels[m];
    const auto index = view.find_label(label);
    if (!index) {
      continue;
    }
    const SignedDistance shape = [&](const Vec3& p) { return shapes(p, label); };
    const ShapePair pair{
        inner_deviation(outward_triangles(view, surface, *index), image.frame, shape, label),
        inner_deviation(outward_triangles(boundaries[m].faces, image.frame), image.frame, shape, label)};
    if (is_known(pair.mesh) && is_known(pair.voxels)) {
      result.push_back(pair);
    }
  }
  std::sort(result.begin(), result.end(),
            [](const ShapePair& a, const ShapePair& b) { return a.mesh.label < b.mesh.label; });
  return result;
}

json to_json(const std::vector<ShapePair>& labels) {
  json object = figures_of(joint(labels, &ShapePair::mesh));
  object["voxel_surface"] = figures_of(joint(labels, &ShapePair::voxels));
  object["per_label"] = json::array();
  for (const ShapePair& pair : labels) {
    json row = figures_of(pair.mesh);
    row["label"] = pair.mesh.label;
    row["voxel_surface"] = figures_of(pair.voxels);
    object["per_label"].push_back(std::move(row));
  }
  return object;
}

}  // namespace cbc3d::metrics
