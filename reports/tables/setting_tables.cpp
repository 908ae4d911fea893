#include "reports/tables/setting_tables.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "baselines/registry.hpp"
#include "reports/results/columns.hpp"
#include "reports/tables/paper_protocol.hpp"

namespace cbc3d::reports {
namespace {

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string product(const Json& list, int decimals) {
  std::string text;
  for (const Json& factor : list) {
    text += (text.empty() ? "" : " x ") + format_number(factor.get<double>(), decimals);
  }
  return text;
}

/// Decimals that show a voxel's size to three digits.
int spacing_decimals(const Json& spacing) {
  double least = 1;
  for (const Json& value : spacing) {
    least = std::min(least, value.get<double>());
  }
  return least >= 0.1 ? 2 : 4;
}

Row image_row(const Json& result, const cases::Case* subject) {
  const Json& image = result["image"];
  const Json& spacing = image["spacing_mm"];
  const bool isotropic = spacing[0] == spacing[1] && spacing[1] == spacing[2];
  std::string labels;
  for (const Json& label : image["labels"]) {
    labels += (labels.empty() ? "" : ", ") + label.dump();
  }
  return {result.value("case", ""),
          subject == nullptr ? "" : subject->title,
          0,
          {text_cell(isotropic ? "isotropic" : "anisotropic"),
           text_cell(std::to_string(image["labels"].size()) + " (labels " + labels + ")"),
           text_cell(product(spacing, spacing_decimals(spacing))), text_cell(product(image["size"], 0))}};
}

const cases::Case* find_case(const std::vector<cases::Case>& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const cases::Case& c) { return c.name == name; });
  return found == cases.end() ? nullptr : &*found;
}

std::string method_of(const std::string& mesher) {
  return mesher.substr(0, mesher.find('-'));
}

/// The parameters in force: what the mesher reports, else what it was given over its defaults.
std::map<std::string, std::string> parameters_in_force(const Json& result) {
  std::map<std::string, std::string> values;
  const Json reported = figure(result, {"mesher_report", "parameters"});
  if (const auto* adapter = baselines::find_adapter(result.value("mesher", ""))) {
    for (const baselines::ParameterSpec& spec : adapter->parameters.in(baselines::program_folder())) {
      values[spec.key] = spec.default_value;
    }
  }
  for (const Json& source : {reported, figure(result, {"parameters"})}) {
    if (source.is_object()) {
      for (const auto& [key, value] : source.items()) {
        values[key] = plain(value);
      }
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

/// The paper's row of a pattern, for an image that is as it was.
const PaperPattern* paper_pattern(const std::string& pattern) {
  const auto& patterns = paper_patterns();
  const auto found = std::find_if(patterns.begin(), patterns.end(),
                                  [&](const PaperPattern& p) { return p.pattern == pattern; });
  return found == patterns.end() ? nullptr : &*found;
}

Cell figure_cell(const Json& value, int decimals, std::optional<double> paper) {
  Cell cell = value.is_number() ? number_cell(value.get<double>(), decimals, paper) : Cell{};
  cell.paper = paper;
  cell.decimals = decimals;
  return cell;
}

Json largest_volume_error(const Json& result) {
  const Json labels = figure(result, {"fidelity", "per_label"});
  Json largest;
  for (const Json& label : labels.is_array() ? labels : Json::array()) {
    const Json error = figure(label, {"volume_error_percent"});
    if (error.is_number() && (largest.is_null() || std::abs(error.get<double>()) > largest.get<double>())) {
      largest = std::abs(error.get<double>());
    }
  }
  return largest;
}

/// The job of the case before with the same mesher and threads, without iterations.
const Json* job_before(const std::vector<Json>& results, const Json& job, const std::string& case_before) {
  for (const Json& candidate : results) {
    const bool same = candidate["mesher"] == job["mesher"] && candidate["threads"] == job["threads"];
    const Json iterations = figure(candidate, {"parameters", "iterations"});
    if (same && candidate.value("case", "") == case_before && candidate.value("status", "") == "ok" &&
        !iterations.is_null() && plain(iterations) == "0") {
      return &candidate;
    }
  }
  return nullptr;
}

Row pattern_row(const std::vector<Json>& results, const Json& job, const cases::DeformationPattern& pattern) {
  const PaperPattern* paper = paper_pattern(pattern.pattern);
  const auto paper_of = [&](double PaperPattern::*member) {
    return paper == nullptr ? std::nullopt : std::optional(paper->*member);
  };
  const Json* before = job_before(results, job, pattern.before);
  Cell distance_before = figure_cell(
      before == nullptr ? Json() : figure(*before, {"fidelity", "hausdorff_mm"}), 2, kPaperHausdorffBeforeMm);
  if (before == nullptr) {
    distance_before.reason =
        "the case " + pattern.before + " has no good job of this mesher with 0 iterations";
  }
  return {
      job.value("case", "") + ", " + job.value("mesher", ""),
      pattern.pattern + ", " + pattern.image,
      2,
      {figure_cell(figure(job, {"mesher_report", "deformation", "targets"}), 0,
                   paper_of(&PaperPattern::target_points)),
       distance_before,
       figure_cell(figure(job, {"fidelity", "hausdorff_mm"}), 2, paper_of(&PaperPattern::hausdorff_mm)),
       figure_cell(figure(job, {"fidelity", "image_to_mesh_mm"}), 2, std::nullopt),
       figure_cell(figure(job, {"fidelity", "mesh_to_image_mm"}), 2, std::nullopt),
       figure_cell(figure(job, {"fidelity", "surface_hausdorff_mm"}), 2, std::nullopt),
       figure_cell(figure(job, {"fidelity", "hd95_mm"}), 2, std::nullopt),
       figure_cell(largest_volume_error(job), 2, std::nullopt),
       figure_cell(figure(job, {"time_s", "stages", "deformation"}), 2, paper_of(&PaperPattern::seconds))}};
}

}  // namespace

Table image_data_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases) {
  Table table{"image_data", "Image data", {"type", "materials", "spacing (mm)", "size (voxels)"},
              {},           "case",       "image"};
  for (const std::string& name : case_names(results)) {
    const auto read = std::find_if(results.begin(), results.end(), [&](const Json& result) {
      return result.value("case", "") == name && figure(result, {"image", "size"}).is_array();
    });
    if (read != results.end()) {
      table.rows.push_back(image_row(*read, find_case(cases, name)));
    } else {
      table.rows.push_back({name, "not read: no mesh of it was evaluated", 0, {{}, {}, {}, {}}});
    }
  }
  for (const PaperImage& image : paper_images()) {
    table.rows.push_back({std::string("paper, ") + image.name,
                          "the paper's own",
                          0,
                          {text_cell(image.type), text_cell(image.materials), text_cell(image.spacing_mm),
                           text_cell(image.size)}});
  }
  return table;
}

Table input_parameter_table(const std::vector<Json>& results) {
  Table table{"input_parameters",
              "Input parameters (the value of most cases first)",
              {"value", "the paper's", "description"},
              {},
              "mesher",
              "parameter"};
  std::vector<std::string> meshers;
  std::map<std::string, std::map<std::string, Values>> values;  // mesher, parameter
  for (const Json& result : results) {
    const std::string mesher = result.value("mesher", "");
    if (std::find(meshers.begin(), meshers.end(), mesher) == meshers.end()) {
      meshers.push_back(mesher);
    }
    for (const auto& [key, value] : parameters_in_force(result)) {
      add_value(values[mesher][key], value, result.value("case", ""));
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

Table deformation_pattern_table(const std::vector<Json>& results, const std::vector<cases::Case>& cases) {
  Table table{
      "deformation_patterns",
      "Deformation patterns (HD: the paper's Hausdorff distance; the paper's nidus, 10 iterations)",
      {"target points", "HD before (mm)", "HD after (mm)", "image to mesh (mm)", "mesh to image (mm)",
       "surface HD (mm)", "95 % surface distance (mm)", "largest volume error (%)", "deformation (s)"},
      {},
      "case, mesher",
      "pattern, image"};
  for (const Json& result : results) {
    const cases::Case* subject = find_case(cases, result.value("case", ""));
    if (subject != nullptr && subject->deformation_pattern && result.value("status", "") == "ok" &&
        result.value("repeat", 0) == 0 &&
        figure(result, {"mesher_report", "deformation", "targets"}).is_number()) {
      table.rows.push_back(pattern_row(results, result, *subject->deformation_pattern));
    }
  }
  return table;
}

}  // namespace cbc3d::reports
