// How smooth the meshes are and how near the true shape, where that is known.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `smoothness`: for every case whose true shape is known (section `shape` of its lines) the metrics
/// that name the table in the catalog, of every mesher's surface and, as a reference, of the voxel faces.
/// Without rows when no shape is known.
Table smoothness_table(const TableInput& input);

}  // namespace cbc3d::reports
