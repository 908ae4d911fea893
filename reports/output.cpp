#include "reports/output.hpp"

#include <iostream>

#include "reports/pictures.hpp"
#include "reports/tables.hpp"

namespace cbc3d::reports {

void write_output(const std::filesystem::path& folder, const std::vector<Json>& results,
                  const std::vector<cases::Case>& cases, const std::filesystem::path& bin_dir,
                  const OutputOptions& options, Progress& progress) {
  const std::vector<Table> tables = build_tables(results, cases);
  write_tables(tables, folder / "tables", options.formats);
  if (options.pictures) {
    draw_pictures(folder, results, bin_dir, progress);
  }
  if (!options.quiet) {
    for (const Table& table : tables) {
      std::cout << to_markdown(table) << '\n';
    }
  }
}

}  // namespace cbc3d::reports
