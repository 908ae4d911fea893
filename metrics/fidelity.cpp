#include "metrics/fidelity.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "metrics/image_boundary.hpp"
#include "metrics/reduce.hpp"
#include "metrics/smooth_surface.hpp"
#include "metrics/volumes.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

// One surface in its three forms.
struct SurfaceParts {
  std::vector<std::uint32_t> facets;  // of the mesh, indices into Surface::facets
  std::vector<VoxelFace> faces;
  std::vector<SmoothTriangle> smooth;

  void append(const SurfaceParts& o) {
    facets.insert(facets.end(), o.facets.begin(), o.facets.end());
    faces.insert(faces.end(), o.faces.begin(), o.faces.end());
    smooth.insert(smooth.end(), o.smooth.begin(), o.smooth.end());
  }
};

std::vector<Vec3> positions(const std::vector<VertexId>& vertices, const std::vector<Vec3>& points) {
  std::vector<Vec3> result(vertices.size());
  std::transform(vertices.begin(), vertices.end(), result.begin(), [&](VertexId v) { return points[v]; });
  return result;
}

class FidelityMeasurer {
 public:
  FidelityMeasurer(const MeshView& view, const LabelImage& image, const Surface& surface,
                   const FidelityOptions& options, const Progress& progress)
      : view_(view), image_(image), surface_(surface), options_(options), progress_(progress) {
    // Labels that the image has not count as background, as the outside does.
    material_of_.assign(view.labels().size(), kBackground);
    for (std::size_t m = 1; m < image.material_count(); ++m) {
      if (const auto index = view.find_label(image.labels[m])) {
        material_of_[*index] = static_cast<MaterialId>(m);
      }
    }
  }

  Fidelity measure() {
    const std::vector<std::size_t> voxels = image_.voxels_per_material();
    Fidelity result;
    result.per_label.reserve(image_.material_count());
    result.labels = compare_labels(view_, image_, voxels);
    volumes_ = label_volumes_mm3(view_);
    progress_.step("overlap", 0.3);
    overlaps_ = count_overlaps(view_, image_);
    progress_.step("image boundaries", 0.4);
    boundaries_ = image_boundaries(image_);
    image_.voxels.page_out();
    const std::size_t labels = image_.material_count();
    for (std::size_t m = 1, reported = 0; m < labels; ++m) {
      if (const std::size_t percent = 100 * m / labels; percent > reported || m == 1) {
        reported = percent;
        progress_.step("distances", 0.45 + 0.5 * static_cast<double>(m - 1) / static_cast<double>(labels));
      }
      if (voxels[m] > 0) {
        measure_label(static_cast<MaterialId>(m), voxels[m], result);
      }
      boundaries_[m] = {};
    }
    progress_.step("distances", 0.95);
    result.outer = outer_is_ ? *outer_is_ : measure_surface(outer_);
    result.outer_points = point_set_distance(outer_voxels(), outer_vertices());
    if (result.interfaces > kMostInterfaces) {
      result.per_interface = {};
    }
    std::sort(result.per_interface.begin(), result.per_interface.end(),
              [](const auto& a, const auto& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });
    return result;
  }

 private:
  [[nodiscard]] SurfaceParts parts_of(MaterialId m) const {
    SurfaceParts parts;
    if (const auto index = view_.find_label(image_.labels[m])) {
      parts.facets = surface_.facets_of[*index];
    }
    parts.faces = boundaries_[m].faces;
    if (options_.smooth) {
      parts.smooth = smooth_surface(image_, m, box_of(boundaries_[m]));
      image_.voxels.page_out();
    }
    return parts;
  }

  // Material on the side of a facet that is not m's.
  [[nodiscard]] MaterialId beyond(std::uint32_t f, MaterialId m) const {
    const SurfaceFacet& facet = surface_.facets[f];
    const MaterialId inside = material_of_[facet.inside];
    const MaterialId outside = facet.outside == kOutside ? kBackground : material_of_[facet.outside];
    return inside == m ? outside : inside;
  }

  [[nodiscard]] SurfaceFidelity measure_surface(const SurfaceParts& parts) const {
    SurfaceFidelity result;
    const auto mesh = searchable_facets(surface_, parts.facets, view_.local_points());
    result.mesh_area_mm2 = mesh.sampled.area_mm2;
    {  // one of the two at a time in memory
      const auto voxel = searchable_voxel_faces(parts.faces, image_.frame);
      result.voxel_area_mm2 = voxel.sampled.area_mm2;
      result.voxel = surface_distance(voxel, mesh, options_.certify);
    }
    if (options_.smooth) {
      const auto smooth = searchable_triangles(parts.smooth);
      result.smooth_area_mm2 = smooth.sampled.area_mm2;
      result.smooth = surface_distance(smooth, mesh, options_.certify);
    }
    return result;
  }

  void measure_label(MaterialId m, std::size_t voxels, Fidelity& result) {
    const Vec3& s = image_.frame.spacing_mm;
    const SurfaceParts parts = parts_of(m);
    LabelFidelity row;
    row.label = image_.labels[m];
    row.voxels = voxels;
    row.image_volume_mm3 = static_cast<double>(voxels) * s.x * s.y * s.z;
    row.overlap = overlaps_[m];
    if (const auto index = view_.find_label(row.label)) {
      row.mesh_volume_mm3 = volumes_[*index];
      row.points = point_set_distance(boundaries_[m].voxel_centres,
                                      positions(surface_.vertices_of[*index], view_.local_points()));
      row.smoothness = smoothness(numbered_facets(surface_, *index, view_.local_points()));
    }
    row.smooth_smoothness = smoothness(numbered_facets(parts.smooth));
    row.surface = measure_surface(parts);
    measure_interfaces(m, parts, row.surface, result);
    result.per_label.push_back(row);
  }

  // Centres of the voxels that show a face to background, each once.
  [[nodiscard]] std::vector<Vec3> outer_voxels() const {
    std::vector<Vec3> centres;
    const VoxelFace* last = nullptr;
    for (const VoxelFace& face : outer_.faces) {  // a voxel's faces lie side by side
      if (last == nullptr || last->voxel != face.voxel) {
        centres.push_back(image_.frame.local_centre(face.voxel[0], face.voxel[1], face.voxel[2]));
      }
      last = &face;
    }
    return centres;
  }

  [[nodiscard]] std::vector<Vec3> outer_vertices() const {
    std::vector<VertexId> vertices;
    for (const std::uint32_t f : outer_.facets) {
      const SurfaceFacet& facet = surface_.facets[f];
      vertices.insert(vertices.end(), facet.nodes.begin(),
                      facet.nodes.begin() + static_cast<std::ptrdiff_t>(facet.corners()));
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return positions(vertices, view_.local_points());
  }

  // Those with background and with the materials before m.
  void measure_interfaces(MaterialId m, const SurfaceParts& parts, const SurfaceFidelity& whole,
                          Fidelity& result) {
    std::map<MaterialId, SurfaceParts> towards;
    for (const std::uint32_t f : parts.facets) {
      towards[beyond(f, m)].facets.push_back(f);
    }
    for (const VoxelFace& face : parts.faces) {
      towards[face.other].faces.push_back(face);
    }
    for (const SmoothTriangle& triangle : parts.smooth) {
      towards[triangle.other].smooth.push_back(triangle);
    }
    const bool alone = towards.size() == 1;
    for (auto& [other, part] : towards) {
      if (other > m) {
        continue;
      }
      const bool in_table = ++result.interfaces <= kMostInterfaces;
      const bool first_outer = other == kBackground && outer_parts_++ == 0;
      SurfaceFidelity surface;
      if (in_table || first_outer) {
        surface = alone ? whole : measure_surface(part);
      }
      if (other == kBackground) {
        outer_is_ = first_outer ? std::optional(surface) : std::nullopt;
        outer_.append(part);
      }
      if (in_table) {
        const auto [a, b] = std::minmax(image_.labels[other], image_.labels[m]);
        result.per_interface.push_back(
            {other == kBackground ? 0 : a, other == kBackground ? image_.labels[m] : b, surface});
      }
    }
  }

  const MeshView& view_;
  const LabelImage& image_;
  const Surface& surface_;
  const FidelityOptions& options_;
  const Progress& progress_;
  std::vector<MaterialId> material_of_;  // by index into MeshView::labels()
  std::vector<double> volumes_;
  std::vector<Overlap> overlaps_;
  std::vector<MaterialBoundary> boundaries_;
  SurfaceParts outer_;
  int outer_parts_ = 0;
  std::optional<SurfaceFidelity> outer_is_;  // when one label alone faces background
};

// Over the surfaces of one or several labels: maxima, and pooled means.
struct Figures {
  std::optional<double> hausdorff, hd95;
  std::optional<DistanceBounds> bounds;
  double sum_mm = 0, sum_mm2 = 0;
  std::int64_t samples = 0;

  void add(const std::optional<SurfaceDistance>& distance) {
    if (!distance) {
      return;
    }
    hausdorff = max_of(hausdorff, distance->hausdorff_mm());
    hd95 = max_of(hd95, distance->hd95_mm());
    for (const DirectedDistance* one : {&distance->image_to_mesh, &distance->mesh_to_image}) {
      sum_mm += one->sampled_sum_mm;
      sum_mm2 += one->sampled_sum_mm2;
      samples += one->samples;
    }
    if (const auto both = distance->bounds()) {
      const DistanceBounds old = bounds.value_or(DistanceBounds{});
      bounds = DistanceBounds{std::max(old.lower_mm, both->lower_mm), std::max(old.upper_mm, both->upper_mm)};
    }
  }
  void write_to(json& object, const std::string& prefix) const {
    const auto per_sample = [this](double sum) {
      return samples > 0 ? std::optional(sum / static_cast<double>(samples)) : std::nullopt;
    };
    const auto mean_square = per_sample(sum_mm2);
    object[prefix + "surface_hausdorff_mm"] = number_or_null(hausdorff);
    object[prefix + "surface_hausdorff_bounds_mm"] =
        bounds ? json{bounds->lower_mm, bounds->upper_mm} : json(nullptr);
    object[prefix + "mean_distance_mm"] = number_or_null(per_sample(sum_mm));
    object[prefix + "rms_distance_mm"] =
        number_or_null(mean_square ? std::optional(std::sqrt(*mean_square)) : std::nullopt);
    object[prefix + "hd95_mm"] = number_or_null(hd95);
  }
};

json directed_json(const DirectedDistance& distance) {
  json object{{"samples", distance.samples}, {"sampled_max_mm", distance.sampled_max_mm},
              {"mean_mm", distance.mean_mm}, {"rms_mm", distance.rms_mm},
              {"p95_mm", distance.p95_mm},   {"hausdorff_bounds_mm", nullptr}};
  if (distance.bounds) {
    object["hausdorff_bounds_mm"] = {distance.bounds->lower_mm, distance.bounds->upper_mm};
  }
  return object;
}

json both_json(const std::optional<SurfaceDistance>& distance) {
  if (!distance) {
    return nullptr;
  }
  return {{"mean_mm", distance->mean_mm()},
          {"rms_mm", distance->rms_mm()},
          {"image_to_mesh", directed_json(distance->image_to_mesh)},
          {"mesh_to_image", directed_json(distance->mesh_to_image)}};
}

void write_surface(json& object, const SurfaceFidelity& surface) {
  for (const auto& [prefix, distance] :
       {std::pair("", &surface.voxel), std::pair("smooth_", &surface.smooth)}) {
    Figures figures;
    figures.add(*distance);
    figures.write_to(object, prefix);
  }
  object["mesh_area_mm2"] = surface.mesh_area_mm2;
  object["voxel_area_mm2"] = surface.voxel_area_mm2;
  object["smooth_area_mm2"] = number_or_null(surface.smooth_area_mm2);
}

/// The figures of each direction on its own.
void write_directions(json& object, const SurfaceFidelity& surface) {
  object["voxel_surface"] = both_json(surface.voxel);
  object["smooth_surface"] = both_json(surface.smooth);
}

double volume_error_percent(const LabelFidelity& row) {
  return 100 * (row.mesh_volume_mm3 - row.image_volume_mm3) / row.image_volume_mm3;
}

void write_points(json& object, const std::optional<double>& image_to_mesh,
                  const std::optional<double>& mesh_to_image) {
  object["hausdorff_mm"] = number_or_null(max_of(image_to_mesh, mesh_to_image));
  object["image_to_mesh_mm"] = number_or_null(image_to_mesh);
  object["mesh_to_image_mm"] = number_or_null(mesh_to_image);
}

void write_points(json& object, const std::optional<PointSetDistance>& points) {
  write_points(object, points ? std::optional(points->image_to_mesh_mm) : std::nullopt,
               points ? std::optional(points->mesh_to_image_mm) : std::nullopt);
}

json label_json(const LabelFidelity& row, bool with_directions) {
  json object{{"label", row.label},
              {"voxels", row.voxels},
              {"image_volume_mm3", row.image_volume_mm3},
              {"mesh_volume_mm3", row.mesh_volume_mm3},
              {"volume_error_percent", volume_error_percent(row)},
              {"dice", row.overlap.dice()},
              {"smoothness", to_json(row.smoothness, row.smooth_smoothness)}};
  write_points(object, row.points);
  write_surface(object, row.surface);
  if (with_directions) {
    write_directions(object, row.surface);
  }
  return object;
}

// What is said of all labels together.
struct Totals {
  std::optional<double> image_to_mesh, mesh_to_image, dice_min, volume_error_max;
  Figures voxel, smooth;

  void add(const LabelFidelity& row) {
    voxel.add(row.surface.voxel);
    smooth.add(row.surface.smooth);
    if (row.points) {
      image_to_mesh = max_of(image_to_mesh, row.points->image_to_mesh_mm);
      mesh_to_image = max_of(mesh_to_image, row.points->mesh_to_image_mm);
    }
    dice_min = std::min(dice_min.value_or(1), row.overlap.dice());
    volume_error_max = max_of(volume_error_max, std::fabs(volume_error_percent(row)));
  }
};

}  // namespace

Fidelity fidelity(const MeshView& view, const LabelImage& image, const Surface& surface,
                  const FidelityOptions& options, const Progress& progress) {
  return FidelityMeasurer(view, image, surface, options, progress).measure();
}

json to_json(const Fidelity& fidelity, const FidelityOptions& options) {
  Totals totals;
  auto per_label = json::array(), per_interface = json::array();
  for (const LabelFidelity& row : fidelity.per_label) {
    totals.add(row);
    per_label.push_back(label_json(row, fidelity.per_label.size() <= kMostInterfaces));
  }
  for (const InterfaceFidelity& row : fidelity.per_interface) {
    per_interface.push_back({{"labels", {row.a, row.b}}});
    write_surface(per_interface.back(), row.surface);
    write_directions(per_interface.back(), row.surface);
  }
  json object{{"dice_min", number_or_null(totals.dice_min)},
              {"volume_error_percent_max", number_or_null(totals.volume_error_max)},
              {"missing_labels", fidelity.labels.missing},
              {"unknown_labels", fidelity.labels.unknown},
              {"surface_tolerance_mm", nullptr},
              {"interfaces", fidelity.interfaces},
              {"outer_surface", json::object()}};
  object["per_label"] = std::move(per_label);
  object["per_interface"] = std::move(per_interface);
  if (options.certify) {
    object["surface_tolerance_mm"] = options.certify->tolerance_mm;
  }
  write_points(object, totals.image_to_mesh, totals.mesh_to_image);
  totals.voxel.write_to(object, "");
  totals.smooth.write_to(object, "smooth_");
  write_points(object["outer_surface"], fidelity.outer_points);
  write_surface(object["outer_surface"], fidelity.outer);
  write_directions(object["outer_surface"], fidelity.outer);
  return object;
}

}  // namespace cbc3d::metrics
