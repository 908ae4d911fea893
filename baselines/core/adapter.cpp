#include "baselines/core/adapter.hpp"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <sstream>

#include "baselines/core/program_file.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines {

struct ParameterSource::Cache {
  Reader reader;
  std::mutex mutex;
  std::map<std::filesystem::path, ParameterSpecs> by_folder;
};

ParameterSource::ParameterSource(Reader reader) : cache_(std::make_shared<Cache>()) {
  cache_->reader = std::move(reader);
}

const ParameterSpecs& ParameterSource::in(const std::filesystem::path& bin_dir) const& {
  const std::lock_guard lock(cache_->mutex);
  const auto known = cache_->by_folder.find(bin_dir);
  return known != cache_->by_folder.end()
             ? known->second
             : cache_->by_folder.emplace(bin_dir, cache_->reader(bin_dir)).first->second;
}

std::filesystem::path program_folder() {
  return program_file().parent_path();
}

Availability executable_availability(const std::filesystem::path& bin_dir, const std::string& executable,
                                     const std::string& remedy) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(bin_dir / executable, ignored)) return {true, ""};
  return {false, remedy};
}

Adapter program_adapter(Adapter mesher, const SizeDial& dial, std::string remedy) {
  const std::string executable = "cbc3d-mesher-" + mesher.name;
  if (remedy.empty()) remedy = "not built: build the target " + executable;
  mesher.availability = [executable, remedy](const std::filesystem::path& bin_dir) {
    return executable_availability(bin_dir, executable, remedy);
  };
  mesher.command = [executable, name = mesher.name, parameters = mesher.parameters](
                       const std::filesystem::path& bin_dir, const MeshJob& job) {
    return protocol_command(bin_dir / executable, name, parameters.in(bin_dir), job);
  };
  mesher.size_dial = [dial](const std::filesystem::path&) { return dial; };
  return mesher;
}

std::filesystem::path find_program(const std::string& program) {
  std::error_code ignored;
  if (program.find('/') != std::string::npos) {
    return std::filesystem::is_regular_file(program, ignored) ? std::filesystem::path(program)
                                                              : std::filesystem::path();
  }
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto candidate = std::filesystem::path(folder.empty() ? "." : folder) / program;
    if (std::filesystem::is_regular_file(candidate, ignored)) return candidate;
  }
  return {};
}

std::optional<SizeDial> size_dial_of(const Adapter& mesher, const std::filesystem::path& bin_dir) {
  return mesher.size_dial ? mesher.size_dial(bin_dir) : std::nullopt;
}

namespace {

std::string unknown_parameter(const std::string& mesher, const ParameterSpecs& known, const std::string& key,
                              const std::string& value) {
  std::string message = mesher + "." + key + "=" + value + ": no such parameter; " + mesher + " knows ";
  for (const ParameterSpec& spec : known) message += (&spec == &known.front() ? "" : ", ") + spec.key;
  return message;
}

}  // namespace

void require_known_parameters(const Adapter& mesher, const std::filesystem::path& bin_dir,
                              const std::map<std::string, std::string>& parameters) {
  const ParameterSpecs& known = mesher.parameters.in(bin_dir);
  if (known.empty() && !mesher.availability(bin_dir).available) return;
  require_known_parameters(mesher.name, known, parameters);
}

void require_known_parameters(const std::string& mesher, const ParameterSpecs& known,
                              const std::map<std::string, std::string>& parameters) {
  for (const auto& parameter : parameters) {
    const auto same = [&](const ParameterSpec& spec) { return spec.key == parameter.first; };
    if (std::any_of(known.begin(), known.end(), same)) continue;
    throw InputError(unknown_parameter(mesher, known, parameter.first, parameter.second));
  }
}

std::vector<std::string> protocol_command(const std::filesystem::path& executable, const std::string& mesher,
                                          const ParameterSpecs& known, const MeshJob& job) {
  require_known_parameters(mesher, known, job.parameters);
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
