#include "reports/tables/target_table.hpp"

#include <algorithm>
#include <cmath>

#include "reports/results/columns.hpp"
#include "reports/tables/measures.hpp"

namespace cbc3d::reports {
namespace {

enum class Limit { none, at_least, at_most };

/// A row of every case.
struct Target {
  const char* name;  ///< without the limit
  int decimals;
  const char* key;    ///< in summary
  const char* where;  ///< key in summary of the worst label or of the list of labels; nullptr: none
  Limit limit;
  double value;  ///< compared with the figure's magnitude
};

const std::vector<Target>& targets() {
  static const std::vector<Target> list{
      {"min dihedral angle (deg)", 2, "min_dihedral_deg", "min_dihedral_label", Limit::at_least, 20},
      {"elements", 0, "elements", nullptr, Limit::none, 0},
      {"HD (mm)", 2, "hausdorff_mm", "hausdorff_label", Limit::none, 0},
      {"HD image to mesh (voxel diagonals)", 2, "image_to_mesh_diagonals", "image_to_mesh_label",
       Limit::at_most, 1.1},
      {"HD mesh to image (voxel diagonals)", 2, "mesh_to_image_diagonals", "mesh_to_image_label",
       Limit::at_most, 1.1},
      {"HD of the union (mm)", 2, "union_hausdorff_mm", nullptr, Limit::none, 0},
      {"HD of the union, image to mesh (voxel diagonals)", 2, "union_image_to_mesh_diagonals", nullptr,
       Limit::at_most, 1.1},
      {"HD of the union, mesh to image (voxel diagonals)", 2, "union_mesh_to_image_diagonals", nullptr,
       Limit::at_most, 1.1},
      {"volume error, labels above 500 voxels (%)", 2, "volume_error_percent", "volume_error_label",
       Limit::at_most, 1},
      {"labels above 50 voxels missing", 0, "missing_labels", "missing_labels", Limit::at_most, 0},
      {"non-manifold edges", 0, "non_manifold_edges", "non_manifold_labels", Limit::at_most, 0},
      {"non-manifold vertices", 0, "non_manifold_vertices", "non_manifold_labels", Limit::at_most, 0},
      {"inverted elements", 0, "inverted", "inverted_labels", Limit::at_most, 0},
      {"self-intersections", 0, "self_intersections", "self_intersection_labels", Limit::at_most, 0}};
  return list;
}

/// The number under a key of summary, or the length of the list there.
FigureOf look_at(const char* key) {
  return [key](const Json& result) -> std::optional<double> {
    const Json value = figure(result, {"summary", key});
    return value.is_array()    ? std::optional(static_cast<double>(value.size()))
           : value.is_number() ? std::optional(value.get<double>())
                               : std::nullopt;
  };
}

std::string name_of(const Target& target) {
  switch (target.limit) {
    case Limit::none:
      return target.name;
    case Limit::at_least:
      return std::string(target.name) + ", at least " + format_number(target.value, 0);
    case Limit::at_most:
      break;
  }
  const bool whole = target.value == std::floor(target.value);
  return std::string(target.name) + ", at most " + format_number(target.value, whole ? 0 : 1);
}

bool is_missed(const Target& target, double value) {
  return (target.limit == Limit::at_least && value < target.value) ||
         (target.limit == Limit::at_most && std::abs(value) > target.value);
}

/// "label 4", "labels 3, 5"; empty when there is none.
std::string labels_text(const Json& labels) {
  constexpr std::size_t kMost = 6;
  if (labels.is_number()) {
    return "label " + labels.dump();
  }
  std::string text;
  for (std::size_t n = 0; labels.is_array() && n < std::min(kMost, labels.size()); ++n) {
    text += (n == 0 ? labels.size() == 1 ? "label " : "labels " : ", ") + labels[n].dump();
  }
  return labels.size() > kMost ? text + " and " + std::to_string(labels.size() - kMost) + " more" : text;
}

/// The label of the first run that ended well.
std::string where_of(const std::vector<const Json*>& runs, const Target& target) {
  const auto good =
      std::find_if(runs.begin(), runs.end(), [](const Json* run) { return text_of(*run, "status") == "ok"; });
  return target.where == nullptr || good == runs.end()
             ? ""
             : labels_text(figure(**good, {"summary", target.where}));
}

Cell target_cell(const std::vector<const Json*>& runs, const Target& target) {
  Cell cell = cell_of(runs, {target.name, target.decimals, "", look_at(target.key)});
  if (cell.value) {
    cell.missed = is_missed(target, *cell.value);
    const bool is_count = target.decimals == 0;
    cell.where = is_count && !cell.missed ? "" : where_of(runs, target);
  }
  return cell;
}

/// How many of a column's cells in these rows are missed.
Cell missed_cell(const std::vector<Row>& rows, std::size_t column) {
  int missed = 0, known = 0;
  std::string reason;
  for (const Row& row : rows) {
    missed += row.cells[column].missed ? 1 : 0;
    known += row.cells[column].value ? 1 : 0;
    reason = row.cells[column].reason;
  }
  Cell cell = number_cell(missed, 0);
  if (known == 0) {
    cell = {};
  }
  cell.reason = reason;
  return cell;
}

}  // namespace

Table target_table(const std::vector<Json>& results) {
  const Columns columns(results);
  Table table{
      "targets",
      "What a good mesh should have (HD: the paper's Hausdorff distance; of the worst label, and of all "
      "labels as one)",
      columns.names(),
      {},
      "case",
      "figure"};
  for (const std::string& case_name : case_names(results)) {
    std::vector<Row> rows;
    for (const Target& target : targets()) {
      Row row{case_name, name_of(target), target.decimals, {}};
      for (const std::string& column : table.columns) {
        row.cells.push_back(target_cell(columns.runs(case_name, column), target));
      }
      rows.push_back(std::move(row));
    }
    Row sum{case_name, "limits missed", 0, {}};
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      sum.cells.push_back(missed_cell(rows, column));
    }
    rows.push_back(std::move(sum));
    table.rows.insert(table.rows.end(), rows.begin(), rows.end());
  }
  return table;
}

namespace {

const std::vector<Measure>& smoothness_measures() {
  static const std::vector<Measure> measures{
      {"normal deviation, mean (deg)", 2, "", at({"shape", "normal_deviation_deg"})},
      {"area excess (%)", 2, "", at({"shape", "area_excess_percent"})},
      {"distance to the shape, mean (mm)", 3, "", at({"shape", "mean_distance_mm"})},
      {"distance to the shape, largest (mm)", 2, "", at({"shape", "max_distance_mm"})}};
  return measures;
}

/// The lines of a case whose true shape is known.
std::vector<const Json*> lines_with_shape(const std::vector<Json>& results, const std::string& case_name) {
  std::vector<const Json*> lines;
  for (const Json& result : results) {
    if (text_of(result, "case") == case_name && smoothness_measures().front().figure(result)) {
      lines.push_back(&result);
    }
  }
  return lines;
}

/// The voxel faces have the same figures beside every mesh that has the same labels: the first that has most
/// is taken.
Cell voxel_cell(const std::vector<const Json*>& lines, const Measure& measure) {
  const auto labels = [](const Json* line) { return figure(*line, {"shape", "per_label"}).size(); };
  const Json* most = *std::max_element(lines.begin(), lines.end(),
                                       [&](const Json* a, const Json* b) { return labels(a) < labels(b); });
  const auto value = measure.figure({{"shape", figure(*most, {"shape", "voxel_surface"})}});
  return value ? number_cell(*value, measure.decimals) : Cell{};
}

}  // namespace

Table smoothness_table(const std::vector<Json>& results) {
  const Columns columns(results);
  Table table{"smoothness",    "Surfaces against the true shape, where that is known",
              columns.names(), {},
              "case",          "figure"};
  for (const std::string& case_name : case_names(results)) {
    const std::vector<const Json*> lines = lines_with_shape(results, case_name);
    for (const Measure& measure : lines.empty() ? std::vector<Measure>{} : smoothness_measures()) {
      Row row{case_name, measure.name, measure.decimals, {}};
      for (const std::string& column : columns.names()) {
        row.cells.push_back(cell_of(columns.runs(case_name, column), measure));
      }
      row.cells.push_back(voxel_cell(lines, measure));
      table.rows.push_back(std::move(row));
    }
  }
  table.columns.push_back("voxel surface");
  return table;
}

}  // namespace cbc3d::reports
