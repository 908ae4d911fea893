#include "reports/tables/tables.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/results/columns.hpp"
#include "reports/tables/measures.hpp"
#include "reports/tables/paper_figure.hpp"
#include "reports/tables/scaling_table.hpp"
#include "reports/tables/speed_table.hpp"
#include "reports/tables/target_table.hpp"

namespace cbc3d::reports {
namespace {

struct TablePlan {
  std::string name;
  std::string title;
  std::vector<Measure> measures;
};

std::optional<double> missing_label_count(const Json& result) {
  const Json missing = figure(result, {"fidelity", "missing_labels"});
  return missing.is_array() ? std::optional(static_cast<double>(missing.size())) : std::nullopt;
}

std::vector<TablePlan> table_plans() {
  constexpr double kMegabytesPerByte = 1e-6;
  return {
      {"element_count", "Element count", {{"tetrahedra", 0, "tets", at({"counts", "tets"})}}},
      {"element_quality",
       "Element quality",
       {{"min dihedral angle (deg)", 2, "min_dihedral_deg", at({"quality", "min_dihedral_deg"})},
        {"max dihedral angle (deg)", 2, "max_dihedral_deg", at({"quality", "max_dihedral_deg"})},
        {"min scaled Jacobian", 4, "", at({"quality", "min_scaled_jacobian"})},
        {"inverted elements", 0, "", at({"quality", "inverted"})},
        {"self-intersections", 0, "", at({"topology", "self_intersections"})}}},
      {"fidelity",
       "Fidelity (HD: the paper's Hausdorff distance of surface vertices and boundary voxels)",
       {{"HD (mm)", 2, "hausdorff_mm", at({"fidelity", "hausdorff_mm"})},
        {"surface Hausdorff distance (mm)", 2, "", at({"fidelity", "surface_hausdorff_mm"})},
        {"95 % surface distance (mm)", 2, "", at({"fidelity", "hd95_mm"})},
        {"largest volume error of a label (%)", 2, "", largest_volume_error},
        {"lowest Dice of a label", 4, "", at({"fidelity", "dice_min"})},
        {"labels missing", 0, "", missing_label_count}}},
      {"time",
       "Time and memory (meshing end to end, without reading and writing files)",
       {{"time (s)", 2, "time_s", at({"time_s", "mesh"})},
        {"CPU time (s)", 2, "", at({"time_s", "cpu"})},
        {"threads", 0, "threads", at({"threads"})},
        {"peak memory (MB)", 0, "", at({"peak_rss_bytes"}, kMegabytesPerByte)}}},
      {"vertices",
       "Vertices and elements of the mixed meshes beside the tetrahedral ones",
       {{"vertices", 0, "vertices", at({"counts", "vertices"})},
        {"tetrahedra", 0, "tets", at({"counts", "tets"})},
        {"pyramids", 0, "pyramids", at({"counts", "pyramids"})},
        {"wedges", 0, "wedges", at({"counts", "wedges"})},
        {"hexahedra", 0, "hexes", at({"counts", "hexes"})}}},
  };
}

bool has_mixed_mesh(const std::vector<Json>& results) {
  const auto count = [](const Json& result, const char* kind) {
    return at({"counts", kind})(result).value_or(0);
  };
  return std::any_of(results.begin(), results.end(), [&](const Json& result) {
    return count(result, "pyramids") + count(result, "wedges") + count(result, "hexes") > 0;
  });
}

Table build_table(const TablePlan& plan, const std::vector<Json>& results,
                  const std::vector<cases::Case>& cases) {
  const Columns columns(results);
  Table table{plan.name, plan.title, columns.names(), {}, "case", "figure"};
  for (const std::string& case_name : case_names(results)) {
    for (const Measure& measure : plan.measures) {
      Row row{case_name, measure.name, measure.decimals, {}};
      for (const std::string& column : table.columns) {
        const std::vector<const Json*> runs = columns.runs(case_name, column);
        row.cells.push_back(cell_of(runs, measure));
        row.cells.back().paper = paper_figure(cases, runs, measure.paper_key);
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace

std::vector<Table> build_tables(const std::vector<Json>& results, const std::vector<cases::Case>& cases) {
  std::vector<Table> tables;
  for (const TablePlan& plan : table_plans()) {
    if (plan.name != "vertices" || has_mixed_mesh(results)) {
      tables.push_back(build_table(plan, results, cases));
    }
  }
  tables.push_back(speed_table(results, cases));
  if (Table scaling = scaling_table(results, cases); !scaling.rows.empty()) {
    tables.push_back(std::move(scaling));
  }
  tables.push_back(target_table(results));
  if (Table smooth = smoothness_table(results); !smooth.rows.empty()) {
    tables.push_back(std::move(smooth));
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
