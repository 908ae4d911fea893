#include "reports/tables/input_parameter_table.hpp"

#include <algorithm>
#include <map>

#include "baselines/registry.hpp"
#include "reports/tables/paper_protocol.hpp"

namespace cbc3d::reports {
namespace {

std::string method_of(const std::string& mesher) {
  return mesher.substr(0, mesher.find('-'));
}

/// The parameters in force: what the mesher reports, else what it was given over its defaults.
Parameters parameters_in_force(const JobResult& result) {
  Parameters values;
  if (const auto* adapter = baselines::find_adapter(result.mesher)) {
    for (const baselines::ParameterSpec& spec : adapter->parameters.in(baselines::program_folder())) {
      values[spec.key] = spec.default_value;
    }
  }
  for (const Parameters* source : {&result.reported_parameters, &result.parameters}) {
    for (const auto& [key, value] : *source) {
      values[key] = value;
    }
  }
  values.erase("threads");
  return values;
}

/// value -> cases that have it, in the order of the cases.
using Values = std::vector<std::pair<std::string, std::vector<std::string>>>;

void add_value(Values& values, const std::string& value, const std::string& case_name) {
  auto entry = std::find_if(values.begin(), values.end(), [&](const auto& e) { return e.first == value; });
  if (entry == values.end()) {
    entry = values.insert(values.end(), {value, {}});
  }
  if (std::find(entry->second.begin(), entry->second.end(), case_name) == entry->second.end()) {
    entry->second.push_back(case_name);
  }
}

/// "10; 0.72 (trabecular-bone)": the value of most cases first, the others with their cases.
std::string values_text(Values values) {
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::string text;
  for (const auto& [value, names] : values) {
    std::string list;
    for (const std::string& name : names) {
      list += (list.empty() ? "" : ", ") + name;
    }
    text += (text.empty() ? "" : "; ") + value + (&names == &values.front().second ? "" : " (" + list + ")");
  }
  return text;
}

std::string description_of(const std::string& mesher, const std::string& key) {
  const auto* adapter = baselines::find_adapter(mesher);
  if (adapter == nullptr) {
    return "";
  }
  for (const baselines::ParameterSpec& spec : adapter->parameters.in(baselines::program_folder())) {
    if (spec.key == key) {
      return spec.description + (spec.unit.empty() ? "" : " [" + spec.unit + "]");
    }
  }
  return "";
}

std::string paper_value(const std::string& mesher, const std::string& key) {
  for (const PaperParameter& parameter : paper_parameters()) {
    if (parameter.method == method_of(mesher) && parameter.parameter == key) {
      return parameter.value;
    }
  }
  return "-";
}

}  // namespace

Table input_parameter_table(const TableInput& input) {
  Table table{"input_parameters",
              "Input parameters (the value of most cases first)",
              {"value", "the paper's", "description"},
              {},
              "mesher",
              "parameter",
              /*on_screen=*/false};
  std::vector<std::string> meshers;
  std::map<std::string, std::map<std::string, Values>> values;  // mesher, parameter
  for (const JobResult& result : input.results) {
    if (std::find(meshers.begin(), meshers.end(), result.mesher) == meshers.end()) {
      meshers.push_back(result.mesher);
    }
    for (const auto& [key, value] : parameters_in_force(result)) {
      add_value(values[result.mesher][key], value, result.case_name);
    }
  }
  for (const std::string& mesher : meshers) {
    for (const auto& [key, entries] : values[mesher]) {
      table.rows.push_back({mesher,
                            key,
                            0,
                            {text_cell(values_text(entries)), text_cell(paper_value(mesher, key)),
                             text_cell(description_of(mesher, key))}});
    }
  }
  for (const PaperParameter& parameter : paper_parameters()) {
    const bool ran = std::any_of(meshers.begin(), meshers.end(), [&](const std::string& mesher) {
      return method_of(mesher) == parameter.method;
    });
    if (!ran) {
      table.rows.push_back({std::string(parameter.method) + " (not run)",
                            parameter.parameter,
                            0,
                            {text_cell("-"), text_cell(parameter.value), text_cell(parameter.description)}});
    }
  }
  return table;
}

}  // namespace cbc3d::reports
