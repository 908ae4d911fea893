// The images of a run.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Table `image_data`: type, materials, spacing and size of every case's image that was read, and of the
/// paper's.
Table image_data_table(const TableInput& input);

}  // namespace cbc3d::reports
