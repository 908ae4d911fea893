#include "reports/tables/measures.hpp"

#include <algorithm>

#include "reports/results/statistics.hpp"

namespace cbc3d::reports {
namespace {

/// Status and reason of a line that is not ok.
std::string failure_of(const Json& result) {
  const std::string status = text_of(result, "status");
  const std::string reason = text_of(result, "reason");
  return reason.empty() ? status : status + ": " + reason;
}

}  // namespace

FigureOf at(std::vector<std::string> path, double factor) {
  return [path = std::move(path), factor](const Json& result) -> std::optional<double> {
    const Json value = figure(result, path);
    return value.is_number() ? std::optional(factor * value.get<double>()) : std::nullopt;
  };
}

std::optional<double> element_count(const Json& result) {
  double count = 0;
  bool known = false;
  for (const char* kind : {"tets", "pyramids", "wedges", "hexes"}) {
    const auto value = at({"counts", kind})(result);
    count += value.value_or(0);
    known = known || value.has_value();
  }
  return known ? std::optional(count) : std::nullopt;
}

std::string text_of(const Json& result, const char* key) {
  return result.value(key, "");
}

Cell cell_of(const std::vector<const Json*>& runs, const Measure& measure) {
  Cell cell;
  std::vector<double> values;
  std::size_t failures = 0;
  for (const Json* run : runs) {
    if (text_of(*run, "status") != "ok") {
      ++failures;
      cell.reason = failure_of(*run);
    } else if (const auto value = measure.figure(*run)) {
      values.push_back(*value);
    }
  }
  const bool whole_process = measure.name == "time (s)" && !runs.empty() &&
                             figure(*runs.front(), {"time_s", "includes_files"}) == true;
  if (runs.empty()) {
    cell.reason = "not run";
  } else if (failures > 0 && failures < runs.size()) {
    cell.reason = std::to_string(failures) + " of " + std::to_string(runs.size()) + " runs " + cell.reason;
  }
  if (!values.empty()) {
    cell.reason +=
        whole_process && cell.reason.empty() ? "whole process, reading and writing files included" : "";
    cell.value = median(values);
    cell.lowest = *std::min_element(values.begin(), values.end());
    cell.highest = *std::max_element(values.begin(), values.end());
    cell.runs = static_cast<int>(values.size());
  }
  return cell;
}

}  // namespace cbc3d::reports
