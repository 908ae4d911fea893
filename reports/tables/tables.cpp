#include "reports/tables/tables.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/tables/table_list.hpp"

namespace cbc3d::reports {

std::vector<Table> build_tables(const TableInput& input) {
  const bool has_budgets = std::any_of(input.results.begin(), input.results.end(),
                                       [](const JobResult& result) { return result.budget.has_value(); });
  std::vector<Table> tables;
  for (const TableBuilder& build : table_list()) {
    if (Table table = build(input); !table.rows.empty()) {
      // With a row for every budget the other tables are too long for a screen.
      table.on_screen = table.on_screen && (!has_budgets || table.name.starts_with("front"));
      tables.push_back(std::move(table));
    }
  }
  return tables;
}

void write_tables(const std::vector<Table>& tables, const std::filesystem::path& folder,
                  const std::vector<std::string>& formats) {
  static const std::map<std::string, std::function<std::string(const Table&)>> writers{
      {"csv", to_csv}, {"md", to_markdown}, {"tex", to_latex}, {"json", [](const Table& table) {
                                                                  return to_json(table).dump(2) + "\n";
                                                                }}};
  for (const std::string& format : formats) {
    if (!writers.contains(format)) {
      throw InputError("--format: '" + format + "' is unknown; give csv, json, md or tex");
    }
  }
  std::filesystem::create_directories(folder);
  for (const Table& table : tables) {
    for (const std::string& format : formats) {
      write_text_file(folder / (table.name + "." + format), writers.at(format)(table));
    }
  }
}

}  // namespace cbc3d::reports
