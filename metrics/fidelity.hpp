// How near a mesh comes to the image: per label, per interface between two labels, and for the whole.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "mesher/core/progress.hpp"
#include "metrics/dice.hpp"
#include "metrics/labels.hpp"
#include "metrics/point_set_hausdorff.hpp"
#include "metrics/smoothness.hpp"
#include "metrics/surface_hausdorff.hpp"

namespace cbc3d::metrics {

/// With more interfaces than this their table would be the bulk of the result, and nobody reads it.
inline constexpr std::size_t kMostInterfaces = 10000;

struct FidelityOptions {
  bool smooth = true;                     ///< distances to the smooth surfaces too (smooth_surface.hpp)
  std::optional<CertifyOptions> certify;  ///< certified bounds of the surface Hausdorff distances
};

/// The distances of one surface. Nothing where mesh or image has no such surface.
struct SurfaceFidelity {
  double mesh_area_mm2 = 0, voxel_area_mm2 = 0;
  std::optional<double> smooth_area_mm2;
  std::optional<SurfaceDistance> voxel, smooth;  ///< to the voxel faces, to the smooth surface
};

struct LabelFidelity {
  Label label = 0;
  std::size_t voxels = 0;
  double image_volume_mm3 = 0, mesh_volume_mm3 = 0;
  Overlap overlap;
  std::optional<PointSetDistance> points;
  SurfaceFidelity surface;
  std::optional<Smoothness> smoothness, smooth_smoothness;  ///< of the mesh, of the smooth surface
};

/// Between two labels, a < b; a = 0 is background and the outside. In the image, the mesh, or both.
struct InterfaceFidelity {
  Label a = 0, b = 0;
  SurfaceFidelity surface;
};

struct Fidelity {
  LabelComparison labels;
  std::vector<LabelFidelity> per_label;          ///< the image's labels with voxels, ascending
  std::vector<InterfaceFidelity> per_interface;  ///< ascending; none when there are more than kMostInterfaces
  std::size_t interfaces = 0;                    ///< how many there are
  SurfaceFidelity outer;                         ///< all labels together against background
  /// The paper's distance of the same: vertices on facets towards background or the outside, centres of
  /// voxels of a label with a face neighbour of background.
  std::optional<PointSetDistance> outer_points;
};

/// Time n log n in voxel faces and facets; memory that of the surfaces of one label beside the image's
/// boundary.
Fidelity fidelity(const MeshView& view, const LabelImage& image, const Surface& surface,
                  const FidelityOptions& options, const Progress& progress);

/// Keys: hausdorff_mm, image_to_mesh_mm, mesh_to_image_mm (the paper's); to the voxel faces
/// surface_hausdorff_mm, mean_distance_mm, rms_distance_mm, hd95_mm (over the samples) and
/// surface_hausdorff_bounds_mm ([lower, upper], certified; null without); to the smooth surface the same,
/// smooth_surface_hausdorff_mm and so on; dice_min, volume_error_percent_max (largest without its sign);
/// missing_labels, unknown_labels; surface_tolerance_mm. Over the labels these are maxima, dice_min the
/// minimum, means pooled. per_label, per_interface (labels: [a, b]) and outer_surface hold the same figures
/// of one surface, its areas (and of a label or outer_surface the paper's distances), and voxel_surface and
/// smooth_surface with each direction's area-weighted figures.
nlohmann::json to_json(const Fidelity& fidelity, const FidelityOptions& options);

}  // namespace cbc3d::metrics
