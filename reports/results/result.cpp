#include "reports/results/result.hpp"

#include <cmath>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace {

Json nulls(const std::vector<const char*>& keys) {
  Json object = Json::object();
  for (const char* key : keys) {
    object[key] = nullptr;
  }
  return object;
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
  result["counts"] = nulls({"vertices", "tets", "pyramids", "wedges", "hexes"});
  result["quality"] = nulls(
      {"min_dihedral_deg", "max_dihedral_deg", "dihedral_histogram_5deg", "min_scaled_jacobian", "inverted"});
  result["fidelity"] = nulls({"hausdorff_mm", "image_to_mesh_mm", "mesh_to_image_mm", "surface_hausdorff_mm",
                              "mean_distance_mm", "hd95_mm", "dice_min", "missing_labels", "per_label"});
  result["topology"] = nulls({"conforming", "non_manifold_edges", "non_manifold_vertices",
                              "self_intersections", "components", "per_label"});
  result["summary"] =
      nulls({"elements", "min_dihedral_deg", "hausdorff_diagonals", "union_hausdorff_diagonals",
             "volume_error_percent", "missing_labels", "self_intersections"});
  result["faults"] = nullptr;
  result["evaluation_peak_mb"] = nullptr;
  result["time_s"] = nulls({"mesh", "cpu", "stages"});
  result["peak_rss_bytes"] = nullptr;
  result["image"] = nulls({"size", "spacing_mm", "labels"});
  result["mesher_report"] = Json::object();
  result["provenance"] = Json::object();
  return result;
}

void merge_evaluation(Json& result, const nlohmann::json& evaluation) {
  for (const char* section : {"counts", "quality", "fidelity", "topology", "summary", "shape", "image"}) {
    if (!evaluation.contains(section) || !evaluation[section].is_object()) {
      continue;
    }
    for (const auto& [key, value] : evaluation[section].items()) {
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
  const std::string line = result.dump() + "\n";
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
    text += result.dump() + "\n";
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
    Json result = Json::parse(line, nullptr, false);
    if (!result.is_object()) {
      throw InputError("'" + file.string() + "': line " + std::to_string(results.size() + 1) +
                       " is no JSON object; remove it");
    }
    for (const char* key : {"case", "mesher"}) {
      if (!result.contains(key) || !result[key].is_string()) {
        throw InputError("'" + file.string() + "': line " + std::to_string(results.size() + 1) + ": \"" +
                         key + "\" is missing or no text; remove the line and run its job again");
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
  return result.value("case", "") + "-" + result.value("mesher", "") + "-t" +
         std::to_string(result.value("threads", 0)) + "-r" + std::to_string(result.value("repeat", 0));
}

std::string file_stem(const Json& result) {
  std::string stem = result_id(result);
  std::replace_if(
      stem.begin(), stem.end(), [](char c) { return c == ':' || c == '/'; }, '_');
  return stem;
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

std::optional<double> largest_volume_error(const Json& result) {
  const Json labels = figure(result, {"fidelity", "per_label"});
  std::optional<double> largest;
  for (const Json& label : labels.is_array() ? labels : Json::array()) {
    const Json error = figure(label, {"volume_error_percent"});
    if (error.is_number()) {
      largest = std::max(largest.value_or(0), std::abs(error.get<double>()));
    }
  }
  return largest;
}

}  // namespace cbc3d::reports
