#include "reports/run/workplace.hpp"

#include <cstdlib>
#include <sstream>
#include <string>

#include "baselines/core/adapter.hpp"
#include "baselines/core/program_file.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace fs = std::filesystem;

fs::path executable_file() {
  return baselines::program_file();
}

fs::path bin_dir() {
  return baselines::program_folder();
}

fs::path manifest_dir() {
  const fs::path folder = bin_dir().parent_path() / "share" / "cbc3d" / "cases";
  if (!fs::is_directory(folder)) {
    throw InputError("no case manifests: the folder '" + folder.string() +
                     "' is missing; build or install again");
  }
  return folder;
}

std::vector<fs::path> data_dirs(const std::vector<fs::path>& given) {
  std::vector<fs::path> folders;
  for (const fs::path& folder : given) {
    if (!fs::is_directory(folder)) {
      throw InputError("--data '" + folder.string() + "': no such folder; give one that holds case images");
    }
    folders.push_back(folder);
  }
  if (const char* variable = std::getenv("CBC3D_DATA")) {
    std::istringstream list(variable);
    for (std::string folder; std::getline(list, folder, ':');) {
      if (!folder.empty()) {
        folders.emplace_back(folder);
      }
    }
  }
  folders.push_back(bin_dir().parent_path() / "data");
  return folders;
}

}  // namespace cbc3d::reports
