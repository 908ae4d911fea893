#include "reports/run/provenance.hpp"

#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "reports/run/build_info.hpp"

namespace cbc3d::reports {
namespace {

std::string cpu_model() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(':');
    if (line.rfind("model name", 0) == 0 && colon + 2 < line.size()) {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

Json load() {
  double average = 0;
  return ::getloadavg(&average, 1) == 1 ? Json(average) : Json();
}

std::string system_name() {
  utsname names{};
  return ::uname(&names) == 0 ? std::string(names.sysname) + " " + names.release + " " + names.machine
                              : "unknown";
}

}  // namespace

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm broken_down{};
  ::gmtime_r(&now, &broken_down);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &broken_down);
  return text;
}

Json provenance() {
  Json result;
  result["cbc3d_version"] = kVersion;
  result["git_commit"] = kGitCommit;
  result["git_commit_date"] = kGitCommitDate;
  result["git_dirty"] = kGitDirty;
  result["compiler"] = kCompiler;
  result["compiler_flags"] = kCompilerFlags;
  result["build_type"] = kBuildType;
  result["libraries"] = {{"itk", kItkVersion}, {"vtk", kVtkVersion}, {"cgal", kCgalVersion}};
  result["cpu"] = cpu_model();
  result["cores"] = std::thread::hardware_concurrency();
  result["memory_bytes"] = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) *
                           static_cast<std::int64_t>(::sysconf(_SC_PAGESIZE));
  result["system"] = system_name();
  result["load_1min"] = load();
  result["utc"] = utc_now();
  return result;
}

}  // namespace cbc3d::reports
