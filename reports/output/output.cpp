#include "reports/output/output.hpp"

#include <iostream>

#include "reports/charts/pictures.hpp"
#include "reports/charts/sweep_figures.hpp"
#include "reports/tables/tables.hpp"

namespace cbc3d::reports {

std::vector<Figure> all_figures(const std::filesystem::path& folder, const std::vector<JobResult>& results) {
  std::vector<Figure> figures = result_figures(results);
  for (Figure& figure : sweep_figures(points_of_sweep(folder, results))) {
    figures.push_back(std::move(figure));
  }
  return figures;
}

void write_output(const std::filesystem::path& folder, const std::vector<JobResult>& results,
                  const std::vector<cases::Case>& cases, const std::filesystem::path& bin_dir,
                  const OutputOptions& options, TerminalProgress& progress) {
  const std::vector<Table> tables = build_tables({results, cases, folder});
  write_tables(tables, folder / "tables", options.formats);
  write_figures(all_figures(folder, results), folder / "figures", progress);
  if (options.pictures) {
    draw_pictures(folder, results, bin_dir, progress);
  }
  if (!options.quiet) {
    for (const Table& table : tables) {
      if (table.on_screen) {
        std::cout << to_markdown(table) << '\n';
      }
    }
  }
}

}  // namespace cbc3d::reports
