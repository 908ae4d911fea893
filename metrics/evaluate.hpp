// Everything that is measured on a mesh, as the JSON of a result line.
#pragma once

#include <nlohmann/json.hpp>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"
#include "metrics/shape_comparison.hpp"

namespace cbc3d::metrics {

/// Default tolerance of the certified distances, in the smallest voxel spacing.
inline constexpr double kRelativeTolerance = 0.02;

/// What is measured.
struct EvaluateOptions {
  bool smooth = true;       ///< distances to and smoothness against the smooth surfaces of the labels
  bool certified = true;    ///< certified bounds of the surface Hausdorff distances
  double tolerance_mm = 0;  ///< upper less lower bound; 0: kRelativeTolerance of the smallest spacing
  LabelShapes shapes = {};  ///< the true shape of the image's labels; empty: not known
};

/// Judges `mesh` (physical LPS mm) against `image`. Returns an object with exactly the keys
///   counts    vertices, tets, pyramids, wedges, hexes;
///   quality   see element_quality.hpp, element_shape.hpp and gradation.hpp;
///   surface   see surface_shape.hpp;
///   fidelity  see fidelity.hpp;
///   topology  see topology.hpp, topology_difference.hpp and self_intersection.hpp;
///   summary   the few figures to look at first, see summary.hpp;
///   shape     only with EvaluateOptions::shapes: the mesh against them, see shape_comparison.hpp;
///   faults    what is wrong with the mesh, one line per fault, see faults.hpp.
/// A figure that cannot be had is null, never NaN. The bytes do not depend on the thread count. Throws
/// InputError when a cell names a vertex that does not exist or a coordinate is not finite.
nlohmann::json evaluate(const Mesh& mesh, const LabelImage& image, const EvaluateOptions& options,
                        const Progress& progress);

}  // namespace cbc3d::metrics
