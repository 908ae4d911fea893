#include "mesher/core/child_process.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <fstream>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr int kFailed = 1;

std::uint64_t virtual_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

void limit(int resource, std::uint64_t most) {
  const rlimit both{most, most};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

void set_limits(const ChildLimits& limits, std::uint64_t at_start) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, limits.cpu_seconds);
#ifndef __SANITIZE_ADDRESS__  // whose shadow memory is larger than any limit
  limit(RLIMIT_AS, at_start + limits.memory_bytes);
#else
  static_cast<void>(at_start);
#endif
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) {
    ::signal(signal, SIG_DFL);
  }
}

[[noreturn]] void be_child(int pipe, const ChildLimits& limits, std::uint64_t at_start,
                           const std::function<void(const ChildOutput&)>& work) {
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDERR_FILENO);
  set_limits(limits, at_start);
  try {
    work(ChildOutput(pipe));
  } catch (...) {
    ::_exit(kFailed);
  }
  ::_exit(0);
}

}  // namespace

void ChildOutput::write(std::span<const std::byte> bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::write(pipe_, bytes.data(), bytes.size());
    if (sent < 0 && errno == EINTR) {
      continue;
    }
    if (sent <= 0) {
      ::_exit(kFailed);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

ChildProcess::ChildProcess(const ChildLimits& limits, const std::function<void(const ChildOutput&)>& work) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    throw JobError("no pipe to a child process; the system has too many files open");
  }
  const std::uint64_t at_start = virtual_bytes();
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[0]);
    be_child(ends[1], limits, at_start, work);
  }
  ::close(ends[1]);
  pipe_ = ends[0];
  if (child_ < 0) {
    ::close(pipe_);
    throw JobError("no child process; the system has too many processes or too little memory");
  }
}

ChildProcess::~ChildProcess() {
  ::close(pipe_);
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
}

bool ChildProcess::read(std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t got = ::read(pipe_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) {
      continue;
    }
    if (got <= 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

std::string ChildProcess::wait() {
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  if (WIFSIGNALED(status)) {
    return WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL
               ? "it takes too long"
               : "signal " + std::to_string(WTERMSIG(status));
  }
  return WEXITSTATUS(status) == 0 ? "" : "an exception";
}

}  // namespace cbc3d
