// What a good mesh should have, mesher by mesher, and what it misses; how smooth it is where that can be
// known.
#pragma once

#include <vector>

#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// For every case the figures of summary (metrics/summary.hpp) with the limits they should keep: smallest
/// dihedral angle 20 degrees, the paper's distance both ways 1.1 voxel diagonals for each label and for all
/// labels as one, volume error of labels above 500 voxels 1 %, no label above 50 voxels missing, nothing
/// non-manifold, inverted or intersecting itself. A cell beyond its limit is marked, with the worst label or
/// the labels in question; the last row of a case counts them. Element count and distances in mm stand there
/// without limit.
Table target_table(const std::vector<Json>& results);

/// For every case whose true shape is known (section `shape` of its lines) the normal deviation, area excess
/// and distance of every mesher's surface and, as a reference, of the voxel faces. Without rows when no case
/// is.
Table smoothness_table(const std::vector<Json>& results);

}  // namespace cbc3d::reports
