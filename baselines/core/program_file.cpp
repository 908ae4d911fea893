#include "baselines/core/program_file.hpp"

#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {

std::filesystem::path program_file() {
  constexpr const char* kLink = "/proc/self/exe";
  std::error_code error;
  std::filesystem::path file = std::filesystem::read_symlink(kLink, error);
  if (error) {
    throw JobError(std::string("cannot find this program's folder by ") + kLink + ": " + error.message() +
                   "; mount /proc (mount -t proc proc /proc)");
  }
  return file;
}

}  // namespace cbc3d::baselines
