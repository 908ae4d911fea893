#include "mesher/core/atomic_file.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <system_error>
#include <utility>

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

std::string file_limit_text() {
  rlimit limit{};
  ::getrlimit(RLIMIT_FSIZE, &limit);
  return "the file would be larger than the limit of " + std::to_string(limit.rlim_cur) +
         " bytes that this process has for files (ulimit -f); raise it";
}

std::string reason_of(int error) {
  switch (error) {
    case 0:
      return "the disk is full or the file cannot be written";
    case ENOSPC:
      return "the disk is full; free some space or choose another place";
    case EDQUOT:
      return "the disk quota is used up; free some space or choose another place";
    case EFBIG:
      return file_limit_text();
    default:
      return std::error_code(error, std::generic_category()).message();
  }
}

}  // namespace

WriteError::WriteError(const fs::path& path, const std::string& reason)
    : JobError("cannot write '" + path.string() + "': " + reason), reason_(reason) {}

void fail_to_write(const fs::path& path, int error) {
  throw WriteError(path, reason_of(error));
}

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
    fail_to_write(path_, error.value());
  }
  committed_ = true;
}

void AtomicFile::fill(const std::function<void(const fs::path&)>& write) {
  try {
    write(temporary_);
  } catch (const WriteError& error) {
    throw WriteError(path_, error.reason());
  }
  commit();
}

void write_text_file(const fs::path& path, std::string_view text) {
  AtomicFile file(path);
  errno = 0;
  std::ofstream out(file.temporary(), std::ios::binary);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    fail_to_write(path);
  }
  file.commit();
}

}  // namespace cbc3d
