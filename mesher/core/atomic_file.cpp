#include "mesher/core/atomic_file.hpp"

#include <unistd.h>

#include <fstream>
#include <system_error>
#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace fs = std::filesystem;

void require_writable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw InputError("cannot write '" + path.string() + "': the folder '" + folder.string() +
                     "' does not exist; create it first");
  }
  if (fs::is_directory(path, error)) {
    throw InputError("cannot write '" + path.string() + "': it is a folder; name a file");
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw InputError("cannot write '" + path.string() + "': no permission to write to the folder '" +
                     folder.string() + "'; choose another place");
  }
  // access() allows what a read-only file system or a pseudo folder then refuses, so a file is tried.
  const fs::path probe = folder / ("." + path.filename().string() + ".probe" + std::to_string(::getpid()));
  const bool created = std::ofstream(probe).good();
  fs::remove(probe, error);
  if (!created) {
    throw InputError("cannot write '" + path.string() + "': no file can be created in the folder '" +
                     folder.string() + "'; choose another place");
  }
}

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)) {
  require_writable(path_);
  temporary_ = path_.parent_path() / ("." + path_.filename().string() + ".part" + std::to_string(::getpid()));
}

AtomicFile::~AtomicFile() {
  if (!committed_) {
    std::error_code error;
    fs::remove(temporary_, error);
  }
}

void AtomicFile::commit() {
  std::error_code error;
  fs::rename(temporary_, path_, error);
  if (error) {
    throw JobError("cannot write '" + path_.string() + "': " + error.message());
  }
  committed_ = true;
}

void write_text_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    throw JobError("cannot write '" + path.string() + "': the disk is full or the file cannot be written");
  }
  file.commit();
}

}  // namespace cbc3d
