// Everything that is measured on a mesh, as the JSON of a result line.
#pragma once

#include <nlohmann/json.hpp>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"

namespace cbc3d::metrics {

/// What is measured; all of it so far.
struct EvaluateOptions {};

/// Judges `mesh` (physical LPS mm) against `image`. Returns an object with exactly the keys
///   counts    vertices, tets, pyramids, wedges, hexes;
///   quality   see element_quality.hpp;
///   fidelity  see point_set_hausdorff.hpp, surface_hausdorff.hpp, dice.hpp, volumes.hpp, labels.hpp;
///   topology  see topology.hpp.
/// A figure that cannot be had is null, never NaN. The bytes do not depend on the thread count. Throws
/// InputError when a cell names a vertex that does not exist or a coordinate is not finite.
nlohmann::json evaluate(const Mesh& mesh, const LabelImage& image, const EvaluateOptions& options,
                        Progress& progress);

}  // namespace cbc3d::metrics
