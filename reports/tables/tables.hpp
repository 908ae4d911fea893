// All tables of a run, and their files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// The tables of the registry (table_list.hpp) that the run has rows for. Columns are mostly meshers, with
/// their threads where one ran with several counts; runs that differ only in the repeat are summed up by
/// their median.
std::vector<Table> build_tables(const TableInput& input);

/// Writes every table as NAME.FORMAT into `folder`, which is made if need be. Formats: csv, json, md, tex.
/// Throws InputError for another one.
void write_tables(const std::vector<Table>& tables, const std::filesystem::path& folder,
                  const std::vector<std::string>& formats);

}  // namespace cbc3d::reports
