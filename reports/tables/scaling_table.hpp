// How a mesher's cost grows with the image.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `scaling`: cost per voxel and per element over one phantom at several resolutions, or over copies of
/// one side by side. A series is a phantom (generator and seed) that a column meshed at two resolutions or
/// more, or in two numbers of copies; its columns are the voxels as multiples of the smallest image's. Rows:
/// elements, then wall and CPU time and every stage of over 5 % of the time at any size, in ns per voxel and
/// us per element; the last column is the largest distance from the median over the sizes in percent of the
/// median, marked above 20 for all but the stages. Medians of the repeats. Without rows when there is no
/// series.
Table scaling_table(const TableInput& input);

}  // namespace cbc3d::reports
