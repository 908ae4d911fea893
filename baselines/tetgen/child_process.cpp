#include "baselines/tetgen/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <thread>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

void drop_standard_streams() {
  const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (null < 0) return;
  ::dup2(null, STDOUT_FILENO);
  ::dup2(null, STDERR_FILENO);
  ::close(null);
}

// Called by the runtime for an exception without a handler, with nothing unwound yet.
[[noreturn]] void end_by_exception() {
  try {
    std::rethrow_exception(std::current_exception());
  } catch (const std::bad_alloc&) {
    ::_exit(kChildOutOfMemory);
  } catch (int number) {
    ::_exit(number >= 0 && number < 100 ? kChildThrewNumber + number : kChildThrew);
  } catch (...) {
    ::_exit(kChildThrew);
  }
}

void write_all(int fd, const void* data, std::size_t bytes) {
  const auto* next = static_cast<const std::byte*>(data);
  while (bytes > 0) {
    const ssize_t written = ::write(fd, next, bytes);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(kChildThrew);
    next += written;
    bytes -= static_cast<std::size_t>(written);
  }
}

[[noreturn]] void be_the_child(const std::function<void(const Send&)>& work, int fd, pid_t parent) {
  // A parent that is killed, for taking too long say, takes its child along.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(kChildThrew);
  }
  drop_standard_streams();
  std::set_terminate(end_by_exception);
  std::thread([&] {
    work([fd](const void* data, std::size_t bytes) { write_all(fd, data, bytes); });
  }).join();
  ::_exit(0);
}

std::vector<std::byte> read_all(int fd) {
  std::vector<std::byte> all;
  std::array<std::byte, 1 << 16> chunk{};
  for (;;) {
    const ssize_t got = ::read(fd, chunk.data(), chunk.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return all;
    all.insert(all.end(), chunk.begin(), chunk.begin() + got);
  }
}

}  // namespace

ChildResult run_in_child(const std::function<void(const Send&)>& work) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw JobError(std::string("no pipe to a child process: ") + std::strerror(errno));
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw JobError(std::string("no child process: ") + std::strerror(errno));
  if (child == 0) {
    ::close(ends[0]);
    be_the_child(work, ends[1], parent);
  }
  ::close(ends[1]);
  ChildResult result;
  result.output = read_all(ends[0]);
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) {
    result.signal = WTERMSIG(status);
  } else {
    result.exit_code = WEXITSTATUS(status);
  }
  return result;
}

}  // namespace cbc3d::baselines
