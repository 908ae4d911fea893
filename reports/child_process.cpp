#include "reports/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/process_group.hpp"

extern char** environ;

namespace cbc3d::reports {
namespace {

constexpr int kPollMilliseconds = 50;
constexpr std::size_t kTailBytes = 16384;
constexpr std::array kEndingSignals{SIGINT, SIGTERM, SIGHUP};

/// Group of the running child, for the signal handler; 0: none.
volatile std::sig_atomic_t running_group = 0;

/// Ends the running child's group and then this process as the signal would have done without a handler.
extern "C" void end_group_and_self(int signal) {
  if (running_group > 0) {
    ::kill(-static_cast<pid_t>(running_group), SIGKILL);
  }
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

/// While alive, the ending signals take the running child's group along.
class SignalGuard {
 public:
  SignalGuard() {
    struct sigaction action {};
    action.sa_handler = end_group_and_self;
    sigemptyset(&action.sa_mask);
    for (std::size_t n = 0; n < kEndingSignals.size(); ++n) {
      ::sigaction(kEndingSignals[n], &action, &former_[n]);
    }
  }
  ~SignalGuard() {
    running_group = 0;
    for (std::size_t n = 0; n < kEndingSignals.size(); ++n) {
      ::sigaction(kEndingSignals[n], &former_[n], nullptr);
    }
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  std::array<struct sigaction, kEndingSignals.size()> former_{};
};

/// While alive, the ending signals wait: between the fork and the note of the child's group they would miss
/// it.
class SignalBlock {
 public:
  SignalBlock() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kEndingSignals) {
      sigaddset(&signals, signal);
    }
    ::sigprocmask(SIG_BLOCK, &signals, &former_);
  }
  ~SignalBlock() { ::sigprocmask(SIG_SETMASK, &former_, nullptr); }
  SignalBlock(const SignalBlock&) = delete;
  SignalBlock& operator=(const SignalBlock&) = delete;
  [[nodiscard]] const sigset_t& former() const { return former_; }

 private:
  sigset_t former_{};
};

struct Pipe {
  int read_end = -1;
  int write_end = -1;
};

Pipe open_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw JobError(std::string("cannot start a process: ") + std::strerror(errno));
  }
  return {ends[0], ends[1]};
}

/// Environment of the child: ours, with the thread counts of the usual pools set.
std::vector<std::string> child_environment(int threads) {
  static constexpr std::array kThreadVariables{"OMP_NUM_THREADS", "OMP_THREAD_LIMIT",
                                               "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", "VTK_SMP_MAX_THREADS",
                                               "OPENBLAS_NUM_THREADS"};
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string key = text.substr(0, text.find('='));
    const bool replaced = threads > 0 && std::find(kThreadVariables.begin(), kThreadVariables.end(), key) !=
                                             kThreadVariables.end();
    if (!replaced) {
      environment.push_back(text);
    }
  }
  for (const char* key : kThreadVariables) {
    if (threads > 0) {
      environment.push_back(key + ("=" + std::to_string(threads)));
    }
  }
  return environment;
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

/// In the child, after the fork: becomes the command. Only async-signal-safe calls, as this process may have
/// threads.
[[noreturn]] void become(const std::vector<char*>& argv, const std::vector<char*>& environment,
                         const Pipe& errors, const Pipe& start, pid_t parent, const sigset_t& signals) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) {
    ::_exit(1);  // the parent died before the line above
  }
  const int null_device = ::open("/dev/null", O_RDWR);
  ::dup2(null_device, STDIN_FILENO);
  ::dup2(null_device, STDOUT_FILENO);
  ::dup2(errors.write_end, STDERR_FILENO);
  for (const int signal : kEndingSignals) {
    ::signal(signal, SIG_DFL);
  }
  ::sigprocmask(SIG_SETMASK, &signals, nullptr);
  ::execvpe(argv[0], argv.data(), environment.data());
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(start.write_end, &error, sizeof error);
  ::_exit(127);
}

struct Started {
  pid_t process = -1;
  int errors = -1;      ///< read end of the child's standard error
  int start_error = 0;  ///< errno of a failed exec
};

/// Waits for the exec: the pipe closes by itself when it succeeds.
int read_start_error(int start) {
  int error = 0;
  ssize_t count = 0;
  do {
    count = ::read(start, &error, sizeof error);
  } while (count < 0 && errno == EINTR);
  return count == sizeof error ? error : 0;
}

Started start_child(const ChildCommand& command) {
  std::vector<std::string> arguments = command.argv;
  std::vector<std::string> variables = child_environment(command.threads);
  const std::vector<char*> argv = pointers_to(arguments);
  const std::vector<char*> environment = pointers_to(variables);
  const Pipe errors = open_pipe();
  const Pipe start = open_pipe();
  const pid_t parent = ::getpid();
  Started started;
  {
    const SignalBlock block;
    started.process = ::fork();
    if (started.process == 0) {
      become(argv, environment, errors, start, parent, block.former());
    }
    if (started.process > 0) {
      ::setpgid(started.process, started.process);  // in both processes: whichever comes first
      running_group = static_cast<std::sig_atomic_t>(started.process);
    }
  }
  ::close(errors.write_end);
  ::close(start.write_end);
  started.errors = errors.read_end;
  if (started.process < 0) {
    ::close(errors.read_end);
    ::close(start.read_end);
    throw JobError(std::string("cannot start a process: ") + std::strerror(errno));
  }
  started.start_error = read_start_error(start.read_end);
  ::close(start.read_end);
  ::fcntl(started.errors, F_SETFL, O_NONBLOCK);
  return started;
}

/// The child's standard error: read as it comes, its end kept.
class Tail {
 public:
  explicit Tail(int descriptor) : descriptor_(descriptor) {}
  ~Tail() { ::close(descriptor_); }
  Tail(const Tail&) = delete;
  Tail& operator=(const Tail&) = delete;

  /// Waits up to the poll interval for output and takes what there is.
  void wait_and_read() {
    pollfd request{open_ ? descriptor_ : -1, POLLIN, 0};
    // A closed pipe mostly means that the child is ending: look again soon.
    ::poll(&request, 1, open_ ? kPollMilliseconds : 2);
    read();
  }
  void read() {
    std::array<char, 4096> buffer{};
    ssize_t count = 0;
    while (open_ && (count = ::read(descriptor_, buffer.data(), buffer.size())) > 0) {
      text_.append(buffer.data(), static_cast<std::size_t>(count));
      if (text_.size() > 2 * kTailBytes) {
        text_.erase(0, text_.size() - kTailBytes);
      }
    }
    open_ = open_ && count != 0;
  }
  [[nodiscard]] std::string text() const {
    return text_.size() > kTailBytes ? text_.substr(text_.size() - kTailBytes) : text_;
  }

 private:
  int descriptor_;
  bool open_ = true;
  std::string text_;
};

/// What ended the wait for a child, and what the kernel then said of it.
struct Ending {
  ChildEnd end = ChildEnd::exited;
  int status = 0;
  rusage usage{};
  std::int64_t peak_rss_bytes = 0;
};

Ending wait_for(pid_t process, Tail& tail, const ChildCommand& command) {
  const Stopwatch watch;
  GroupMemory memory(process);
  Ending ending;
  while (::wait4(process, &ending.status, WNOHANG, &ending.usage) == 0) {
    const std::int64_t used = memory.sample();
    ending.peak_rss_bytes = std::max(ending.peak_rss_bytes, used);
    const bool late = command.timeout_s > 0 && watch.seconds() > command.timeout_s;
    const bool large = command.memory_limit_bytes > 0 && used > command.memory_limit_bytes;
    if (late || large) {
      ending.end = large ? ChildEnd::out_of_memory : ChildEnd::timeout;
      ::kill(-process, SIGKILL);
      ::wait4(process, &ending.status, 0, &ending.usage);
      break;
    }
    tail.wait_and_read();
  }
  ::kill(-process, SIGKILL);  // whatever the child left behind
  tail.read();
  return ending;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildResult run_child(const ChildCommand& command) {
  const SignalGuard guard;
  const Stopwatch watch;
  const Started started = start_child(command);
  Tail tail(started.errors);
  const Ending ending = wait_for(started.process, tail, command);
  ChildResult result;
  result.end = ending.end;
  result.wall_s = watch.seconds();
  result.cpu_s = seconds_of(ending.usage.ru_utime) + seconds_of(ending.usage.ru_stime);
  result.peak_rss_bytes =
      std::max(ending.peak_rss_bytes, static_cast<std::int64_t>(ending.usage.ru_maxrss) * 1024);
  result.stderr_tail = tail.text();
  if (started.start_error != 0) {
    result.end = ChildEnd::not_started;
    result.stderr_tail = "cannot run '" + command.argv.front() + "': " + std::strerror(started.start_error);
  } else if (result.end == ChildEnd::exited && WIFSIGNALED(ending.status)) {
    result.end = ChildEnd::signalled;
    result.signal = WTERMSIG(ending.status);
  } else if (WIFEXITED(ending.status)) {
    result.exit_code = WEXITSTATUS(ending.status);
  }
  return result;
}

std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string::npos) {
    return {};
  }
  const std::size_t before = text.find_last_of("\r\n", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return text.substr(begin, end + 1 - begin);
}

std::string signal_name(int signal) {
  const char* abbreviation = ::sigabbrev_np(signal);
  const std::string name =
      abbreviation != nullptr ? std::string("SIG") + abbreviation : "signal " + std::to_string(signal);
  const char* description = ::sigdescr_np(signal);
  return description != nullptr ? name + " (" + description + ")" : name;
}

}  // namespace cbc3d::reports
