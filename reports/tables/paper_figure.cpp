#include "reports/tables/paper_figure.hpp"

#include <algorithm>

#include "reports/tables/measures.hpp"

namespace cbc3d::reports {
namespace {

/// The paper's Hausdorff distance after a deformation with the run's own pattern and iterations, as a case's
/// manifest has it from the table on deformation.
std::optional<double> paper_deformation_figure(const nlohmann::json& deformation, const Json& run) {
  const Json pattern = figure(run, {"parameters", "connectivity"});
  const Json iterations = figure(run, {"parameters", "iterations"});
  const std::string expected = deformation.value("iterations", nlohmann::json()).dump();
  if (!pattern.is_string() || !iterations.is_string() || iterations.get<std::string>() != expected) {
    return std::nullopt;
  }
  const auto value = at({"patterns", pattern.get<std::string>(), "hausdorff_mm"});
  return value(Json(deformation));
}

/// The paper's figure beside a run's: that under the mesher's name, or under its method's (cbc3d-paper and
/// cbc3d are one, a mixed mesh is not), or for a distance that of the table on deformation.
std::optional<double> figure_of_case(const cases::Case& subject, const Json& run, const std::string& key) {
  const std::string mesher = text_of(run, "mesher");
  const std::string method = mesher == "cbc3d-mixed" ? mesher : mesher.substr(0, mesher.find('-'));
  for (const std::string& name : {mesher, method}) {
    if (const auto value = at({name, key})(Json(subject.paper))) {
      return value;
    }
  }
  const bool deformed = method == "cbc3d" && key == "hausdorff_mm" && subject.paper.contains("deformation");
  return deformed ? paper_deformation_figure(subject.paper["deformation"], run) : std::nullopt;
}

}  // namespace

std::optional<double> paper_figure(const std::vector<cases::Case>& cases,
                                   const std::vector<const Json*>& runs, const std::string& key) {
  if (runs.empty() || key.empty()) {
    return std::nullopt;
  }
  const std::string name = text_of(*runs.front(), "case");
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const cases::Case& c) { return c.name == name; });
  return found == cases.end() ? std::nullopt : figure_of_case(*found, *runs.front(), key);
}

}  // namespace cbc3d::reports
