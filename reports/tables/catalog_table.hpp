// Tables whose rows are metrics of the catalog.
#pragma once

#include <string>

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// A table of the metrics that name it in the catalog: for every case a row of each, for every mesher a
/// column.
TableBuilder catalog_table(const std::string& name, const std::string& title);

/// The same table, but without rows where no mesh of the run has other elements than tetrahedra.
TableBuilder for_mixed_meshes(const TableBuilder& table);

/// The same table, but without rows where the run asked no solver (`run --solve`).
TableBuilder for_solved_meshes(const TableBuilder& table);

}  // namespace cbc3d::reports
