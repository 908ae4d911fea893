// The tables of a results file: element count, element quality, fidelity, time, vertices of mixed meshes,
// speed (speed_table.hpp), scaling (scaling_table.hpp), targets and smoothness (target_table.hpp).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/core/case.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// Tables from result lines. Columns are meshers, with their threads where one ran with several counts; runs
/// that differ only in the repeat are summed up by their median. `cases` gives the paper's figures.
std::vector<Table> build_tables(const std::vector<Json>& results, const std::vector<cases::Case>& cases);

/// Writes every table as NAME.FORMAT into `folder`, which is made if need be. Formats: csv, json, md, tex.
/// Throws InputError for another one.
void write_tables(const std::vector<Table>& tables, const std::filesystem::path& folder,
                  const std::vector<std::string>& formats);

}  // namespace cbc3d::reports
