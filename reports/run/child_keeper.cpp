#include "reports/run/child_keeper.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace {

// The runner may have threads, so after its fork only async-signal-safe calls are made, down to the exec.

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

struct Pipes {
  Pipe errors, report, lifeline, start;
};

/// The command in the form that exec takes.
struct Program {
  std::vector<char*> argv, environment;
  std::int64_t file_limit_bytes = 0;
};

constexpr std::array kEndingSignals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE};

Pipe open_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw JobError(std::string("cannot start a process: ") + std::strerror(errno));
  }
  return {ends[0], ends[1]};
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

/// No file may grow beyond this, or beyond what the system allows.
void limit_files(std::int64_t bytes) {
  rlimit limit{};
  if (bytes > 0 && ::getrlimit(RLIMIT_FSIZE, &limit) == 0) {
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, static_cast<rlim_t>(bytes));
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
}

[[noreturn]] void become(const Program& program, const Pipes& pipes, pid_t keeper) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != keeper) {
    ::_exit(1);  // the keeper died before the line above
  }
  const int null_device = ::open("/dev/null", O_RDWR);
  ::dup2(null_device, STDIN_FILENO);
  ::dup2(null_device, STDOUT_FILENO);
  ::dup2(pipes.errors.write_end, STDERR_FILENO);
  for (const int signal : kEndingSignals) {
    ::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  limit_files(program.file_limit_bytes);
  ::execvpe(program.argv[0], program.argv.data(), program.environment.data());
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(pipes.start.write_end, &error, sizeof error);
  ::_exit(127);
}

/// Waits for the exec: the pipe closes by itself when it succeeds.
int read_start_error(int start) {
  int error = 0;
  ssize_t count = 0;
  do {
    count = ::read(start, &error, sizeof error);
  } while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

/// Kills the keeper's children; theirs become its own as they die.
void kill_children() {
  std::array<char, 64> name{};
  const int self = ::getpid();
  std::snprintf(name.data(), name.size(), "/proc/%d/task/%d/children", self, self);
  const int file = ::open(name.data(), O_RDONLY | O_CLOEXEC);
  std::array<char, 4096> text{};
  const ssize_t count = file < 0 ? 0 : ::read(file, text.data(), text.size() - 1);
  if (file >= 0) {
    ::close(file);
  }
  const char* end = text.data() + (count > 0 ? count : 0);
  for (char* at = text.data(); at < end;) {
    char* next = at;
    const long process = std::strtol(at, &next, 10);
    if (next == at) {
      return;
    }
    ::kill(static_cast<pid_t>(process), SIGKILL);
    at = next;
  }
}

/// The keeper's work, in its own process.
class Keeper {
 public:
  Keeper(const Program& program, const Pipes& pipes) : program_(program), pipes_(pipes) {}

  [[noreturn]] void run() {
    ::setpgid(0, 0);  // out of reach of the terminal's signals
    for (const int signal : kEndingSignals) {
      ::signal(signal, SIG_IGN);
    }
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    ::close(pipes_.lifeline.write_end);
    ::close(pipes_.errors.read_end);
    ::close(pipes_.report.read_end);
    start();
    wait();
    end_all();
    [[maybe_unused]] const ssize_t written = ::write(pipes_.report.write_end, &report_, sizeof report_);
    ::_exit(0);
  }

 private:
  void start() {
    struct sigaction action {};
    action.sa_handler = [](int) {};
    ::sigaction(SIGCHLD, &action, nullptr);
    sigset_t child_signal;
    sigemptyset(&child_signal);
    sigaddset(&child_signal, SIGCHLD);
    ::sigprocmask(SIG_SETMASK, &child_signal, nullptr);
    const pid_t keeper = ::getpid();
    child_ = ::fork();
    if (child_ == 0) {
      become(program_, pipes_, keeper);
    }
    report_.start_error = child_ < 0 ? errno : 0;
    gone_ = child_ < 0;
    ::close(pipes_.start.write_end);
    ::close(pipes_.errors.write_end);
    if (child_ > 0) {
      ::setpgid(child_, child_);  // in both processes: whichever comes first
      report_.start_error = read_start_error(pipes_.start.read_end);
    }
  }

  /// Until the command ends or the lifeline closes. SIGCHLD is blocked but during the poll, so that an end
  /// between the look and the poll is not missed.
  void wait() {
    sigset_t none;
    sigemptyset(&none);
    while (reap(), !gone_) {
      pollfd lifeline{pipes_.lifeline.read_end, POLLIN, 0};
      if (::ppoll(&lifeline, 1, nullptr, &none) > 0) {
        return;
      }
    }
  }

  /// Takes the processes that have ended. False when there is none left at all.
  bool reap() {
    while (true) {
      int status = 0;
      rusage usage{};
      const pid_t process = ::wait4(-1, &status, WNOHANG, &usage);
      if (process == child_ && process > 0) {
        report_.wait_status = status;
        report_.usage = usage;
        gone_ = true;
      }
      if (process <= 0) {
        return process == 0;
      }
    }
  }

  void end_all() {
    constexpr int kRounds = 10000;  // about ten seconds; what cannot be killed by then hangs in the kernel
    if (child_ > 0) {
      ::kill(-child_, SIGKILL);
    }
    for (int round = 0; round < kRounds && reap(); ++round) {
      kill_children();
      ::usleep(1000);
    }
  }

  const Program& program_;
  const Pipes& pipes_;
  pid_t child_ = -1;
  bool gone_ = false;
  KeeperReport report_;
};

}  // namespace

KeptChild start_kept_child(std::vector<std::string> argv, std::vector<std::string> variables,
                           std::int64_t file_limit_bytes) {
  const Program program{pointers_to(argv), pointers_to(variables), file_limit_bytes};
  const Pipes pipes{open_pipe(), open_pipe(), open_pipe(), open_pipe()};
  const pid_t keeper = ::fork();
  if (keeper == 0) {
    Keeper(program, pipes).run();
  }
  const int error = errno;
  for (const int end : {pipes.errors.write_end, pipes.report.write_end, pipes.lifeline.read_end,
                        pipes.start.read_end, pipes.start.write_end}) {
    ::close(end);
  }
  if (keeper < 0) {
    for (const int end : {pipes.errors.read_end, pipes.report.read_end, pipes.lifeline.write_end}) {
      ::close(end);
    }
    throw JobError(std::string("cannot start a process: ") + std::strerror(error));
  }
  ::fcntl(pipes.errors.read_end, F_SETFL, O_NONBLOCK);
  return {keeper, pipes.errors.read_end, pipes.report.read_end, pipes.lifeline.write_end};
}

}  // namespace cbc3d::reports
