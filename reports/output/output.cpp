#include "reports/output/output.hpp"

#include <iostream>

#include "reports/charts/pictures.hpp"
#include "reports/sweep/sweep.hpp"
#include "reports/tables/setting_tables.hpp"
#include "reports/tables/tables.hpp"

namespace cbc3d::reports {

std::vector<Table> all_tables(const std::filesystem::path& folder, const std::vector<Json>& results,
                              const std::vector<cases::Case>& cases) {
  std::vector<Table> tables = build_tables(results, cases);
  Table patterns = deformation_pattern_table(results, cases);
  if (!patterns.rows.empty()) {
    tables.push_back(std::move(patterns));
  }
  if (std::filesystem::exists(folder / "sweep.json")) {
    for (Table& table : sweep_tables(sweep_points(results))) {
      tables.push_back(std::move(table));
    }
  }
  if (std::filesystem::exists(folder / "microbenchmarks.json")) {
    tables.push_back(microbenchmark_table(read_microbenchmarks({folder / "microbenchmarks.json"})));
  }
  tables.push_back(image_data_table(results, cases));
  tables.push_back(input_parameter_table(results));
  return tables;
}

std::vector<Figure> all_figures(const std::filesystem::path& folder, const std::vector<Json>& results) {
  std::vector<Figure> figures = result_figures(results);
  if (std::filesystem::exists(folder / "sweep.json")) {
    for (Figure& figure : sweep_figures(sweep_points(results))) {
      figures.push_back(std::move(figure));
    }
  }
  return figures;
}

void write_output(const std::filesystem::path& folder, const std::vector<Json>& results,
                  const std::vector<cases::Case>& cases, const std::filesystem::path& bin_dir,
                  const OutputOptions& options, TerminalProgress& progress) {
  const std::vector<Table> tables = all_tables(folder, results, cases);
  write_tables(tables, folder / "tables", options.formats);
  write_figures(all_figures(folder, results), folder / "figures", progress);
  if (options.pictures) {
    draw_pictures(folder, results, bin_dir, progress);
  }
  if (!options.quiet) {
    for (const Table& table : tables) {
      if (table.name != "input_parameters") {
        std::cout << to_markdown(table) << '\n';
      }
    }
  }
}

}  // namespace cbc3d::reports
