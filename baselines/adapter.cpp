#include "baselines/adapter.hpp"

#include <algorithm>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {

Availability executable_availability(const std::filesystem::path& bin_dir, const std::string& executable,
                                     const std::string& remedy) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(bin_dir / executable, ignored)) return {true, ""};
  return {false, remedy};
}

void require_known_parameters(const std::string& mesher, const std::vector<ParameterSpec>& known,
                              const MeshJob& job) {
  for (const auto& [key, value] : job.parameters) {
    const bool found =
        std::any_of(known.begin(), known.end(), [&](const auto& spec) { return spec.key == key; });
    if (found) continue;
    std::string keys;
    for (const ParameterSpec& spec : known) keys += (keys.empty() ? "" : ", ") + spec.key;
    throw InputError(mesher + "." + key + "=" + value + ": no such parameter; " + mesher + " knows " + keys);
  }
}

std::vector<std::string> protocol_command(const std::filesystem::path& executable, const std::string& mesher,
                                          const std::vector<ParameterSpec>& known, const MeshJob& job) {
  require_known_parameters(mesher, known, job);
  std::vector<std::string> argv{executable.string(),         "--image",  job.image.string(),  "--out",
                                job.mesh.string(),           "--report", job.report.string(), "--threads",
                                std::to_string(job.threads), "--quiet"};
  for (const auto& [key, value] : job.parameters) {
    argv.push_back("--" + key);
    argv.push_back(value);
  }
  return argv;
}

}  // namespace cbc3d::baselines
