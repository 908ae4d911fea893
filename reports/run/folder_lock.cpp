#include "reports/run/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::reports {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".lock";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) {
    throw JobError("cannot write '" + file.string() + "': " + std::strerror(errno));
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    std::array<char, 64> holder{};
    const ssize_t length = ::read(descriptor_, holder.data(), holder.size() - 1);
    ::close(descriptor_);
    throw InputError("--out '" + folder.string() + "' is in use by another runner (process " +
                     (length > 0 ? std::string(holder.data()) : "unknown") +
                     "); wait for its end or give another folder");
  }
  // For the message above alone: a full disk does no harm here.
  const std::string self = std::to_string(::getpid());
  [[maybe_unused]] const int cleared = ::ftruncate(descriptor_, 0);
  [[maybe_unused]] const ssize_t written = ::write(descriptor_, self.data(), self.size());
}

FolderLock::~FolderLock() {
  ::close(descriptor_);
}

}  // namespace cbc3d::reports
