// A mesh and, as a reference, the voxel faces of the image, both against the true shape of its labels.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "metrics/shape_deviation.hpp"

namespace cbc3d::metrics {

/// Signed distance of a label's region at a physical LPS position, mm, negative inside; NaN where it is not
/// known. Called from several threads.
using LabelShapes = std::function<double(const Vec3& physical_mm, Label label)>;

/// A label in both forms.
struct ShapePair {
  ShapeDeviation mesh, voxels;
};

/// The image's labels whose shape is known at every place that is asked for, and that the mesh has,
/// ascending. What lies within a voxel of the image's border is left out: there shapes are cut off. Of more
/// than 30,000 triangles of a surface that many are looked at, evenly picked.
std::vector<ShapePair> compare_with_shapes(const MeshView& view, const LabelImage& image,
                                           const Surface& surface, const LabelShapes& shapes);

/// Keys: normal_deviation_deg, max_normal_deviation_deg, area_excess_percent, mean_distance_mm,
/// max_distance_mm: over the labels together, means by area; voxel_surface: the same of the voxel faces;
/// per_label: label and all of these. Null figures and an empty list where no label's shape is known.
nlohmann::json to_json(const std::vector<ShapePair>& labels);

}  // namespace cbc3d::metrics
