// Volume of every label in the mesh.
#pragma once

#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// Signed volume of the cells of each label, mm3, by index into MeshView::labels(). Cells other than tets
/// count as the tets of split_into_tets, exact where their quads are flat.
std::vector<double> label_volumes_mm3(const MeshView& view);

}  // namespace cbc3d::metrics
