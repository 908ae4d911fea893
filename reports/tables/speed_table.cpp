#include "reports/tables/speed_table.hpp"

#include <algorithm>

#include "reports/results/columns.hpp"
#include "reports/tables/measures.hpp"
#include "reports/tables/paper_figure.hpp"

namespace cbc3d::reports {
namespace {

std::optional<double> elements_per_second(const Json& result) {
  const auto elements = element_count(result), seconds = at({"time_s", "mesh"})(result);
  return elements && seconds && *seconds > 0 ? std::optional(*elements / *seconds) : std::nullopt;
}

std::optional<double> core_seconds(const Json& result) {
  const auto seconds = at({"time_s", "mesh"})(result), threads = at({"threads"})(result);
  return seconds && threads ? std::optional(*seconds * *threads) : std::nullopt;
}

const std::vector<Measure>& measures() {
  constexpr double kMegabytesPerByte = 1e-6;
  static const std::vector<Measure> list{
      {"elements", 0, "", element_count},
      {"time (s)", 2, "time_s", at({"time_s", "mesh"})},
      {"time with files (s)", 2, "", at({"time_s", "process_wall"})},
      {"CPU time (s)", 2, "", at({"time_s", "cpu"})},
      {"threads", 0, "threads", at({"threads"})},
      {"elements per second", 0, "", elements_per_second},
      {"HD (mm)", 2, "hausdorff_mm", at({"fidelity", "hausdorff_mm"})},
      {"peak memory (MB)", 0, "", at({"peak_rss_bytes"}, kMegabytesPerByte)}};
  return list;
}

/// The rows of one case.
class CaseRows {
 public:
  CaseRows(const Columns& columns, const std::vector<cases::Case>& cases, const std::string& case_name)
      : names_(columns.names()), cases_(cases), case_name_(case_name) {
    for (const std::string& name : names_) runs_.push_back(columns.runs(case_name, name));
  }

  std::vector<Row> all() {
    for (const Measure& measure : measures()) add(measure);
    for (std::size_t reference = 0; reference < names_.size(); ++reference) {
      if (is_reference(reference)) {
        add_multiples("elements", measures()[0], reference);
        add_multiples("time", measures()[1], reference);
        add_multiples("CPU time", measures()[3], reference);
      }
    }
    add_core_seconds();
    return std::move(rows_);
  }

 private:
  [[nodiscard]] bool is_reference(std::size_t column) const {
    const std::string mesher = runs_[column].empty() ? "" : text_of(*runs_[column].front(), "mesher");
    return mesher == "cbc3d" || mesher == "cbc3d-paper";
  }

  void add(const Measure& measure) {
    Row row{case_name_, measure.name, measure.decimals, {}};
    for (const auto& runs : runs_) {
      row.cells.push_back(cell_of(runs, measure));
      row.cells.back().paper = paper_figure(cases_, runs, measure.paper_key);
    }
    rows_.push_back(std::move(row));
  }

  void add_multiples(const std::string& what, const Measure& measure, std::size_t reference) {
    const auto base = cell_of(runs_[reference], measure).value;
    if (!base || *base <= 0 || names_.size() < 2) return;
    Row row{case_name_, what + " over " + names_[reference] + "'s", 2, {}};
    for (const auto& runs : runs_) {
      const auto value = cell_of(runs, measure).value;
      row.cells.push_back(value ? number_cell(*value / *base, 2) : Cell{});
    }
    rows_.push_back(std::move(row));
  }

  void add_core_seconds() {
    Row ours{case_name_, "core-seconds (time x threads)", 2, {}}, quotient{case_name_, "", 1, {}};
    quotient.figure = "the paper's core-seconds over these";
    bool known = false;
    for (const auto& runs : runs_) {
      Cell cell = cell_of(runs, {ours.figure, ours.decimals, "", core_seconds});
      const auto seconds = paper_figure(cases_, runs, "time_s"),
                 threads = paper_figure(cases_, runs, "threads");
      if (seconds && threads) cell.paper = *seconds * *threads;
      const bool both = cell.paper && cell.value && *cell.value > 0;
      quotient.cells.push_back(both ? number_cell(*cell.paper / *cell.value, 1) : Cell{});
      known = known || both;
      ours.cells.push_back(std::move(cell));
    }
    rows_.push_back(std::move(ours));
    if (known) rows_.push_back(std::move(quotient));
  }

  const std::vector<std::string>& names_;
  const std::vector<cases::Case>& cases_;
  std::string case_name_;
  std::vector<std::vector<const Json*>> runs_;  ///< of each column
  std::vector<Row> rows_;
};

}  // namespace

Table speed_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases) {
  const Columns columns(results);
  Table table{"speed",
              "Speed (HD: the paper's Hausdorff distance; the paper's core-seconds: on its own image and "
              "machine)",
              columns.names(),
              {},
              "case",
              "figure"};
  for (const std::string& case_name : case_names(results)) {
    for (Row& row : CaseRows(columns, cases, case_name).all()) table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace cbc3d::reports
