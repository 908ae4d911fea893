#include "reports/gate/gate_job.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/results/statistics.hpp"

namespace cbc3d::reports {
namespace {

using Lines = std::vector<const Json*>;

std::vector<std::string> path_of(const std::string& name) {
  std::vector<std::string> path;
  std::size_t begin = 0;
  for (std::size_t dot = 0; (dot = name.find('.', begin)) != std::string::npos; begin = dot + 1) {
    path.push_back(name.substr(begin, dot - begin));
  }
  path.push_back(name.substr(begin));
  return path;
}

std::optional<double> value_of(const Json& line, const std::string& name) {
  if (name == "volume_error_percent") {
    return largest_volume_error(line);
  }
  const Json value = figure(line, path_of(name));
  if (value.is_boolean()) {
    return value.get<bool>() ? 1 : 0;
  }
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::vector<double> values_of(const Lines& lines, const std::string& name) {
  std::vector<double> values;
  for (const Json* line : lines) {
    if (const auto value = value_of(*line, name)) {
      values.push_back(*value);
    }
  }
  return values;
}

/// The least disturbed of the job's CPU times over the least disturbed of the reference's.
std::optional<double> time_ratio(const Lines& lines) {
  const std::vector<double> cpu = values_of(lines, "time_s.cpu");
  const std::vector<double> reference = values_of(lines, "time_s.reference_cpu");
  if (cpu.empty() || reference.empty()) {
    return std::nullopt;
  }
  const double unit = *std::min_element(reference.begin(), reference.end());
  return unit > 0 ? std::optional(*std::min_element(cpu.begin(), cpu.end()) / unit) : std::nullopt;
}

std::optional<double> joint_value(const Lines& lines, const GateFigure& figure) {
  const std::string name = figure.name;
  if (name == "time_ratio") {
    return time_ratio(lines);
  }
  const std::vector<double> values = values_of(lines, name);
  if (values.empty()) {
    return std::nullopt;
  }
  return name == "peak_rss_bytes" ? *std::min_element(values.begin(), values.end()) : median(values);
}

std::string failure_of(const Lines& lines) {
  for (const Json* line : lines) {
    const std::string status = line->value("status", "");
    if (status != "ok") {
      return status + (line->value("reason", "").empty() ? "" : ": " + line->value("reason", ""));
    }
  }
  return "";
}

/// Repeats of a deterministic mesher give the same mesh.
std::string first_difference(const Lines& lines) {
  for (const Json* line : lines) {
    for (const char* key : {"mesh_sha256", "counts"}) {
      if (line->contains(key) && lines.front()->contains(key) && (*line)[key] != (*lines.front())[key]) {
        return std::string(key) + " is " + (*lines.front())[key].dump() + " in repeat " +
               std::to_string(lines.front()->value("repeat", 0)) + " and " + (*line)[key].dump() +
               " in repeat " + std::to_string(line->value("repeat", 0));
      }
    }
  }
  return "";
}

std::vector<long> missing_labels(const Lines& lines) {
  std::set<long> labels;
  for (const Json* line : lines) {
    const Json missing = figure(*line, {"fidelity", "missing_labels"});
    for (const Json& label : missing.is_array() ? missing : Json::array()) {
      labels.insert(label.get<long>());
    }
  }
  return {labels.begin(), labels.end()};
}

GateJob joint(const Lines& lines) {
  const Json& first = *lines.front();
  GateJob job;
  job.name = gate_job_name(first);
  job.identity = {{"case", first["case"]},
                  {"mesher", first["mesher"]},
                  {"threads", first["threads"]},
                  {"parameters", first.value("parameters", Json::object())}};
  const Json deterministic = figure(first, {"provenance", "mesher_deterministic"});
  job.deterministic = !deterministic.is_boolean() || deterministic.get<bool>();
  job.failure = failure_of(lines);
  job.first_difference = job.deterministic && job.failure.empty() ? first_difference(lines) : "";
  job.missing_labels = missing_labels(lines);
  for (const GateFigure& wanted : gate_figures()) {
    if (const auto value = joint_value(lines, wanted)) {
      job.figures[wanted.name] = *value;
    }
  }
  return job;
}

}  // namespace

const std::vector<GateFigure>& gate_figures() {
  static const std::vector<GateFigure> figures{
      {"counts.vertices", "vertices", "", Worse::other, "counts"},
      {"counts.tets", "tetrahedra", "", Worse::other, "counts"},
      {"counts.pyramids", "pyramids", "", Worse::other, "counts"},
      {"counts.wedges", "wedges", "", Worse::other, "counts"},
      {"counts.hexes", "hexahedra", "", Worse::other, "counts"},
      {"topology.components", "components", "", Worse::other, "counts"},
      {"quality.inverted", "inverted elements", "", Worse::higher, "exact"},
      {"quality.min_dihedral_deg", "smallest dihedral angle", "deg", Worse::lower, "angle"},
      {"quality.max_dihedral_deg", "largest dihedral angle", "deg", Worse::higher, "angle"},
      {"quality.min_scaled_jacobian", "smallest scaled Jacobian", "", Worse::lower, "jacobian"},
      {"fidelity.hausdorff_mm", "Hausdorff distance (the paper's)", "mm", Worse::higher, "distance"},
      {"fidelity.surface_hausdorff_mm", "surface Hausdorff distance", "mm", Worse::higher, "distance"},
      {"fidelity.hd95_mm", "95 % surface distance", "mm", Worse::higher, "distance"},
      {"fidelity.mean_distance_mm", "mean surface distance", "mm", Worse::higher, "distance"},
      {"fidelity.dice_min", "lowest Dice of a label", "", Worse::lower, "dice"},
      {"volume_error_percent", "largest volume error of a label", "%", Worse::higher, "volume"},
      {"topology.conforming", "conforming", "", Worse::lower, "exact"},
      {"topology.non_manifold_edges", "non-manifold edges", "", Worse::higher, "exact"},
      {"topology.non_manifold_vertices", "non-manifold vertices", "", Worse::higher, "exact"},
      {"topology.self_intersections", "self-intersections", "", Worse::higher, "exact"},
      {"peak_rss_bytes", "peak memory", "bytes", Worse::higher, "memory"},
      {"time_ratio", "CPU time over the reference work's", "", Worse::higher, "time"}};
  return figures;
}

std::string gate_job_name(const Json& job) {
  const int threads = job.value("threads", 1);
  return job.value("case", "") + ", " + job.value("mesher", "") + ", " + std::to_string(threads) +
         (threads == 1 ? " thread" : " threads");
}

std::vector<GateJob> gate_jobs(const std::vector<Json>& results) {
  std::vector<std::string> order;
  std::map<std::string, Lines> lines;
  for (const Json& result : results) {
    const std::string name = gate_job_name(result);
    if (!lines.contains(name)) {
      order.push_back(name);
    }
    lines[name].push_back(&result);
  }
  std::vector<GateJob> jobs;
  for (const std::string& name : order) {
    jobs.push_back(joint(lines.at(name)));
  }
  return jobs;
}

}  // namespace cbc3d::reports
