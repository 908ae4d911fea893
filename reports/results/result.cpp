#include "reports/results/result.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "metrics/catalog.hpp"

namespace cbc3d::reports {
namespace {

Json nulls(const std::vector<const char*>& keys) {
  Json object = Json::object();
  for (const char* key : keys) {
    object[key] = nullptr;
  }
  return object;
}

/// A null for every metric of the catalog that stands in a line.
void add_metrics(Json& result) {
  for (const metrics::Metric& metric : metrics::kCatalog) {
    if (metric.source == metrics::Source::line) {
      Json* at = &result;
      for (const std::string& key : split_path(metric.key)) {
        at = &(*at)[key];
      }
    }
  }
}

/// True for the first key of a metric such as "fidelity.hausdorff_mm".
bool is_section(const std::string& name) {
  return std::any_of(std::begin(metrics::kCatalog), std::end(metrics::kCatalog),
                     [&](const metrics::Metric& metric) { return metric.key.starts_with(name + "."); });
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

Json empty_result() {
  Json result = nulls({"case", "mesher", "threads", "repeat"});
  result["parameters"] = Json::object();
  result["status"] = nullptr;
  result["reason"] = "";
  result["mesh_file"] = nullptr;
  result["mesh_sha256"] = nullptr;
  for (const char* section : {"counts", "quality", "surface", "fidelity", "topology", "solver", "summary"}) {
    result[section] = Json::object();  // in the order in which people read a line
  }
  add_metrics(result);
  for (const char* section : {"surface", "fidelity", "topology"}) {
    result[section]["per_label"] = nullptr;
  }
  result["quality"]["dihedral_histogram_5deg"] = nullptr;
  result["solver"]["reason"] = nullptr;
  result["faults"] = nullptr;
  result["evaluation_peak_mb"] = nullptr;
  result["time_s"]["stages"] = nullptr;
  result["image"] = nulls({"size", "spacing_mm", "labels"});
  result["mesher_report"] = Json::object();
  result["provenance"] = Json::object();
  return result;
}

void merge_evaluation(Json& result, const nlohmann::json& evaluation) {
  for (const auto& [section, figures] : evaluation.items()) {
    if (!figures.is_object() || !(section == "image" || is_section(section))) {
      continue;
    }
    for (const auto& [key, value] : figures.items()) {
      result[section][key] = value;
    }
  }
  for (const char* key : {"faults", "evaluation_peak_mb"}) {
    if (evaluation.contains(key)) {
      result[key] = evaluation[key];
    }
  }
}

void append_result(const std::filesystem::path& file, const Json& result) {
  const std::string line = json_text(result, -1) + "\n";
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    throw JobError("cannot write '" + file.string() + "': " + std::strerror(errno));
  }
  const off_t former_size = ::lseek(descriptor, 0, SEEK_END);
  const ssize_t written = ::write(descriptor, line.data(), line.size());
  const int write_error = written < 0 ? errno : ENOSPC;
  const bool good = written == static_cast<ssize_t>(line.size()) && ::fsync(descriptor) == 0;
  if (!good && former_size >= 0) {
    [[maybe_unused]] const int cut = ::ftruncate(descriptor, former_size);  // no half line stays
  }
  ::close(descriptor);
  if (!good) {
    throw JobError("cannot write '" + file.string() + "': " + std::strerror(write_error) +
                   "; make room and go on with --resume");
  }
}

void replace_results(const std::filesystem::path& file, const std::vector<Json>& results) {
  std::string text;
  for (const Json& result : results) {
    text += json_text(result, -1) + "\n";
  }
  write_text_file(file, text);
}

std::vector<Json> read_results(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  std::vector<Json> results;
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    if (line.empty()) {
      continue;
    }
    const std::string subject = "'" + file.string() + "': line " + std::to_string(results.size() + 1);
    Json result = parse_json<Json>(std::string_view(line), subject);
    if (!result.is_object()) {
      throw InputError(subject + " is no JSON object; remove it");
    }
    for (const char* key : {"case", "mesher"}) {
      if (!result.contains(key) || !result[key].is_string()) {
        throw InputError(subject + ": \"" + key +
                         "\" is missing or no text; remove the line and run its job again");
      }
    }
    results.push_back(std::move(result));
  }
  return results;
}

void drop_torn_line(const std::filesystem::path& file) {
  const std::string text = read_text(file);
  if (!text.empty() && text.back() != '\n') {
    std::filesystem::resize_file(file, text.rfind('\n') + 1);  // npos + 1 is 0: no whole line
  }
}

std::string result_id(const Json& result) {
  const auto text = [&](const char* key) {
    const Json value = figure(result, {key});
    return value.is_string() ? value.get<std::string>() : std::string();
  };
  const auto number = [&](const char* key) {
    const Json value = figure(result, {key});
    return std::to_string(value.is_number_integer() ? value.get<int>() : 0);
  };
  const Json budget = figure(result, {"budget"});
  const std::string of_budget =
      budget.is_number_integer() ? "-n" + std::to_string(budget.get<std::int64_t>()) : "";
  return text("case") + "-" + text("mesher") + of_budget + "-t" + number("threads") + "-r" + number("repeat");
}

std::string file_stem(const Json& result) {
  std::string stem = result_id(result);
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return c == ':' || c == '/'; }, '_');
  return stem;
}

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> keys;
  std::size_t begin = 0;
  for (std::size_t dot = 0; (dot = path.find('.', begin)) != std::string_view::npos; begin = dot + 1) {
    keys.emplace_back(path.substr(begin, dot - begin));
  }
  keys.emplace_back(path.substr(begin));
  return keys;
}

Json figure(const Json& result, const std::vector<std::string>& path) {
  const Json* at = &result;
  for (const std::string& key : path) {
    if (!at->is_object() || !at->contains(key)) {
      return nullptr;
    }
    at = &(*at)[key];
  }
  return *at;
}

}  // namespace cbc3d::reports
