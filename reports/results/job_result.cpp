#include "reports/results/job_result.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/input/names_json.hpp"

namespace cbc3d::reports {
namespace {

using metrics::Figures;
using metrics::metric;
using metrics::Metric;
using metrics::MetricId;

const Json kNull;

const Json& at(const Json& object, const std::string& key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  return found == object.end() ? kNull : *found;
}

/// What stands at a path such as "fidelity.hausdorff_mm".
const Json& at_path(const Json& line, std::string_view path) {
  const Json* value = &line;
  for (const std::string& key : split_path(path)) {
    value = &at(*value, key);
  }
  return *value;
}

/// The value where it is an object, else an empty one.
const Json& object_or_empty(const Json& value) {
  static const Json empty = Json::object();
  return value.is_object() ? value : empty;
}
const Json& object_or_empty(Json&&) = delete;  // what it returns would be gone

/// The value where it is a list, else an empty one.
const Json& list_or_empty(const Json& value) {
  static const Json empty = Json::array();
  return value.is_array() ? value : empty;
}
const Json& list_or_empty(Json&&) = delete;

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : std::string();
}

int integer_of(const Json& value, int otherwise) {
  return value.is_number_integer() ? value.get<int>() : otherwise;
}

std::optional<double> number_of(const Json& value) {
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

/// Those entries of a list that are numbers.
template <class Number>
std::vector<Number> numbers_of(const Json& list) {
  std::vector<Number> numbers;
  for (const Json& value : list_or_empty(list)) {
    if (value.is_number()) {
      numbers.push_back(value.get<Number>());
    }
  }
  return numbers;
}

Parameters parameters_of(const Json& object) {
  Parameters parameters;
  for (const auto& [key, value] : object_or_empty(object).items()) {
    parameters[key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return parameters;
}

std::optional<double> figure_of(const Json& value) {
  return value.is_boolean() ? std::optional(value.get<bool>() ? 1.0 : 0.0)
         : value.is_array() ? std::optional(static_cast<double>(value.size()))
                            : number_of(value);
}

/// The largest magnitude at a path such as "fidelity.per_label.dice", whose last key is that of each label.
std::optional<double> worst_of_labels(const Json& line, std::string_view path) {
  const std::size_t dot = path.rfind('.');
  const Json& labels = at_path(line, path.substr(0, dot));
  std::optional<double> worst;
  for (const Json& label : list_or_empty(labels)) {
    if (const auto value = number_of(at(label, std::string(path.substr(dot + 1))))) {
      worst = std::max(worst.value_or(0), std::abs(*value));
    }
  }
  return worst;
}

Figures figures_of(const Json& line) {
  Figures figures;
  for (const MetricId id : metrics::all_metrics()) {
    const Metric& row = metric(id);
    if (row.source == metrics::Source::line) {
      figures[id] = figure_of(at_path(line, row.key));
    } else if (row.source == metrics::Source::labels) {
      figures[id] = worst_of_labels(line, row.per_label);
    }
  }
  figures.derive();
  return figures;
}

std::map<MetricId, std::vector<long>> worst_labels_of(const Json& line) {
  std::map<MetricId, std::vector<long>> worst;
  for (const MetricId id : metrics::all_metrics()) {
    if (!metric(id).worst_label.empty()) {
      const Json& labels = at_path(line, metric(id).worst_label);
      worst[id] = labels.is_number() ? std::vector{labels.get<long>()} : numbers_of<long>(labels);
    }
  }
  return worst;
}

std::optional<ImageData> image_of(const Json& image) {
  if (!at(image, "size").is_array()) {
    return std::nullopt;
  }
  return ImageData{numbers_of<std::int64_t>(at(image, "size")), numbers_of<double>(at(image, "spacing_mm")),
                   numbers_of<std::int64_t>(at(image, "labels")), names_of_json(at(image, "label_names"))};
}

std::vector<std::pair<std::string, double>> stages_of(const Json& stages) {
  std::vector<std::pair<std::string, double>> seconds;
  for (const auto& [name, value] : object_or_empty(stages).items()) {
    if (value.is_number()) {
      seconds.emplace_back(name, value.get<double>());
    }
  }
  return seconds;
}

void decode_identity(const Json& line, JobResult& result) {
  result.case_name = text_of(at(line, "case"));
  result.mesher = text_of(at(line, "mesher"));
  result.threads = integer_of(at(line, "threads"), 1);
  result.repeat = integer_of(at(line, "repeat"), 0);
  if (const Json& budget = at(line, "budget"); budget.is_number_integer()) {
    result.budget = budget.get<std::int64_t>();
  }
  result.budget_shortfall = text_of(at_path(line, "size_search.reason"));
  result.parameters = parameters_of(at(line, "parameters"));
  result.id = result_id(line);
}

void decode_outcome(const Json& line, JobResult& result) {
  result.status = text_of(at(line, "status"));
  result.reason = text_of(at(line, "reason"));
  result.mesh_file = text_of(at(line, "mesh_file"));
  result.mesh_sha256 = text_of(at(line, "mesh_sha256"));
  result.image = image_of(at(line, "image"));
  result.stage_seconds = stages_of(at_path(line, "time_s.stages"));
  result.includes_files = at_path(line, "time_s.includes_files") == true;
  result.reported_parameters = parameters_of(at_path(line, "mesher_report.parameters"));
  result.target_points = number_of(at_path(line, "mesher_report.deformation.targets"));
  result.mesher_is_deterministic = at_path(line, "provenance.mesher_deterministic") != false;
  result.image_file = text_of(at_path(line, "provenance.image_file"));
}

void decode_figures(const Json& line, JobResult& result) {
  result.figures = figures_of(line);
  result.worst_labels = worst_labels_of(line);
  result.missing_labels = numbers_of<long>(at_path(line, "fidelity.missing_labels"));
  result.solver_reason = text_of(at_path(line, "solver.reason"));
  result.dihedral_histogram = numbers_of<double>(at_path(line, "quality.dihedral_histogram_5deg"));
  result.voxel_surface = figures_of({{"shape", at_path(line, "shape.voxel_surface")}});
  result.labels_with_shape = at_path(line, "shape.per_label").size();
}

}  // namespace

std::optional<double> JobResult::stage(const std::string& name) const {
  const auto found = std::find_if(stage_seconds.begin(), stage_seconds.end(),
                                  [&](const auto& stage) { return stage.first == name; });
  return found == stage_seconds.end() ? std::nullopt : std::optional(found->second);
}

Json JobResult::provenance(const char* key) const {
  return at(at(line, "provenance"), key);
}

JobResult decode(Json line) {
  JobResult result;
  decode_identity(line, result);
  decode_outcome(line, result);
  decode_figures(line, result);
  result.line = std::move(line);
  return result;
}

std::vector<JobResult> decode_lines(std::vector<Json> lines) {
  std::vector<JobResult> results;
  results.reserve(lines.size());
  for (Json& line : lines) {
    results.push_back(decode(std::move(line)));
  }
  return results;
}

std::vector<JobResult> results_of(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "results.jsonl";
  std::vector<JobResult> results = decode_lines(read_results(file));
  if (results.empty()) {
    throw InputError("'" + file.string() + "': no results; name the --out folder of a run");
  }
  return results;
}

std::string failure_of(const JobResult& result) {
  return result.reason.empty() ? result.status : result.status + ": " + result.reason;
}

std::string summary_line(const std::vector<JobResult>& results) {
  std::string text = std::to_string(results.size()) + (results.size() == 1 ? " job:" : " jobs:");
  const char* separator = " ";
  for (const char* status : kStatuses) {
    const auto count = std::count_if(results.begin(), results.end(),
                                     [&](const JobResult& result) { return result.status == status; });
    if (count > 0) {
      text += separator + std::to_string(count) + " " + status;
      separator = ", ";
    }
  }
  return text;
}

}  // namespace cbc3d::reports
