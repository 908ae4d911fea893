#include "metrics/evaluate.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "metrics/cells.hpp"
#include "metrics/dice.hpp"
#include "metrics/element_quality.hpp"
#include "metrics/image_boundary.hpp"
#include "metrics/labels.hpp"
#include "metrics/point_set_hausdorff.hpp"
#include "metrics/reduce.hpp"
#include "metrics/surface.hpp"
#include "metrics/surface_hausdorff.hpp"
#include "metrics/topology.hpp"
#include "metrics/volumes.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

json counts_of(const Mesh& mesh) {
  return {{"vertices", mesh.points.size()},
          {"tets", mesh.tets.size()},
          {"pyramids", mesh.pyramids.size()},
          {"wedges", mesh.wedges.size()},
          {"hexes", mesh.hexes.size()}};
}

// The fidelity of one label of the image.
struct LabelFidelity {
  Label label = 0;
  std::size_t voxels = 0;
  double image_volume_mm3 = 0, mesh_volume_mm3 = 0;
  Overlap overlap;
  std::optional<PointSetDistance> points;
  std::optional<SurfaceDistance> surface;
};

std::vector<Vec3> positions(const std::vector<VertexId>& vertices, const std::vector<Vec3>& points) {
  std::vector<Vec3> result(vertices.size());
  std::transform(vertices.begin(), vertices.end(), result.begin(), [&](VertexId v) { return points[v]; });
  return result;
}

std::vector<LabelFidelity> measure_labels(const MeshView& view, const LabelImage& image,
                                          const std::vector<std::size_t>& voxels, const Surface& surface,
                                          Progress& progress) {
  const Vec3& s = image.frame.spacing_mm;
  const std::vector<double> volumes = label_volumes_mm3(view);
  progress.step("overlap", 0.3);
  const std::vector<Overlap> overlaps = count_overlaps(rasterise(view, image), image);
  progress.step("image boundaries", 0.45);
  const std::vector<MaterialBoundary> boundaries = image_boundaries(image);
  std::vector<LabelFidelity> rows;
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    progress.step("distances", 0.5 + 0.5 * static_cast<double>(m - 1) / static_cast<double>(voxels.size()));
    if (voxels[m] == 0) {
      continue;
    }
    LabelFidelity row;
    row.label = image.labels[m];
    row.voxels = voxels[m];
    row.image_volume_mm3 = static_cast<double>(voxels[m]) * s.x * s.y * s.z;
    row.overlap = overlaps[m];
    if (const auto index = view.find_label(row.label)) {
      row.mesh_volume_mm3 = volumes[*index];
      row.points = point_set_distance(boundaries[m].voxel_centres,
                                      positions(surface.vertices_of[*index], view.local_points()));
      row.surface = surface_distance(boundaries[m].faces, image.frame, surface, *index, view.local_points());
    }
    rows.push_back(row);
  }
  return rows;
}

// The distances of one label or, as the largest (mean: pooled) over them, of all.
struct Distances {
  std::optional<double> image_to_mesh, mesh_to_image, surface_hausdorff, hd95;
  double sum_mm = 0;
  std::int64_t samples = 0;

  void add(const LabelFidelity& row) {
    if (row.points) {
      image_to_mesh = max_of(image_to_mesh, row.points->image_to_mesh_mm);
      mesh_to_image = max_of(mesh_to_image, row.points->mesh_to_image_mm);
    }
    if (row.surface) {
      surface_hausdorff = max_of(surface_hausdorff, row.surface->hausdorff_mm);
      hd95 = max_of(hd95, row.surface->hd95_mm);
      sum_mm += row.surface->sum_mm;
      samples += row.surface->samples;
    }
  }
  void write_to(json& object) const {
    std::optional<double> mean;
    if (samples > 0) {
      mean = sum_mm / static_cast<double>(samples);
    }
    object["hausdorff_mm"] = number_or_null(max_of(image_to_mesh, mesh_to_image));
    object["image_to_mesh_mm"] = number_or_null(image_to_mesh);
    object["mesh_to_image_mm"] = number_or_null(mesh_to_image);
    object["surface_hausdorff_mm"] = number_or_null(surface_hausdorff);
    object["mean_distance_mm"] = number_or_null(mean);
    object["hd95_mm"] = number_or_null(hd95);
  }
};

json label_json(const LabelFidelity& row) {
  json object{
      {"label", row.label},
      {"voxels", row.voxels},
      {"image_volume_mm3", row.image_volume_mm3},
      {"mesh_volume_mm3", row.mesh_volume_mm3},
      {"volume_error_percent", 100 * (row.mesh_volume_mm3 - row.image_volume_mm3) / row.image_volume_mm3},
      {"dice", row.overlap.dice()}};
  Distances distances;
  distances.add(row);
  distances.write_to(object);
  return object;
}

json fidelity_json(const std::vector<LabelFidelity>& rows, const LabelComparison& labels) {
  Distances all;
  std::optional<double> dice_min;
  auto per_label = json::array();
  for (const LabelFidelity& row : rows) {
    all.add(row);
    dice_min = std::min(dice_min.value_or(1), row.overlap.dice());
    per_label.push_back(label_json(row));
  }
  json object{{"dice_min", number_or_null(dice_min)},
              {"missing_labels", labels.missing},
              {"unknown_labels", labels.unknown},
              {"per_label", per_label}};
  all.write_to(object);
  return object;
}

}  // namespace

json evaluate(const Mesh& mesh, const LabelImage& image, const EvaluateOptions& /*options*/,
              Progress& progress) {
  const MeshView view(mesh, image);
  progress.step("element quality", 0);
  json result{{"counts", counts_of(mesh)}, {"quality", to_json(element_quality(view), view)}};
  progress.step("topology", 0.1);
  std::vector<Facet> facets = sorted_facets(view);
  const Surface surface = extract_surface(view, facets);
  result["topology"] = to_json(topology(view, facets, surface), view);
  facets = {};
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  result["fidelity"] = fidelity_json(measure_labels(view, image, voxels, surface, progress),
                                     compare_labels(view, image, voxels));
  progress.step("evaluated", 1);
  return result;
}

}  // namespace cbc3d::metrics
