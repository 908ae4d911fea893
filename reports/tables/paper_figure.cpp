#include "reports/tables/paper_figure.hpp"

#include <algorithm>

namespace cbc3d::reports {
namespace {

std::optional<double> number_at(const nlohmann::json& object, const std::vector<std::string>& path) {
  const Json value = figure(Json(object), path);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::string parameter(const JobResult& run, const char* key) {
  const auto found = run.parameters.find(key);
  return found == run.parameters.end() ? "" : found->second;
}

/// The paper's Hausdorff distance after a deformation with the run's own pattern and iterations, as a case's
/// manifest has it from the table on deformation.
std::optional<double> paper_deformation_figure(const nlohmann::json& deformation, const JobResult& run) {
  const std::string expected = deformation.value("iterations", nlohmann::json()).dump();
  return parameter(run, "iterations") == expected
             ? number_at(deformation, {"patterns", parameter(run, "connectivity"), "hausdorff_mm"})
             : std::nullopt;
}

/// The paper's figure beside a run's: that under the mesher's name, or under its method's (cbc3d-paper and
/// cbc3d are one, a mixed mesh is not), or for a distance that of the table on deformation.
std::optional<double> figure_of_case(const cases::Case& subject, const JobResult& run,
                                     const std::string& key) {
  const std::string method =
      run.mesher == "cbc3d-mixed" ? run.mesher : run.mesher.substr(0, run.mesher.find('-'));
  for (const std::string& name : {run.mesher, method}) {
    if (const auto value = number_at(subject.paper, {name, key})) {
      return value;
    }
  }
  const bool deformed = method == "cbc3d" && key == "hausdorff_mm" && subject.paper.contains("deformation");
  return deformed ? paper_deformation_figure(subject.paper["deformation"], run) : std::nullopt;
}

}  // namespace

std::optional<double> paper_figure(const std::vector<cases::Case>& cases, const Runs& runs,
                                   std::string_view key) {
  if (runs.empty() || key.empty()) {
    return std::nullopt;
  }
  const auto found = std::find_if(cases.begin(), cases.end(),
                                  [&](const cases::Case& c) { return c.name == runs.front()->case_name; });
  return found == cases.end() ? std::nullopt : figure_of_case(*found, *runs.front(), std::string(key));
}

}  // namespace cbc3d::reports
