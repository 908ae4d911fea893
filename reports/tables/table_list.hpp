// The registry of tables.
#pragma once

#include <vector>

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// Every table, in the order in which they are shown. A new table is one row here beside its own files.
const std::vector<TableBuilder>& table_list();

}  // namespace cbc3d::reports
