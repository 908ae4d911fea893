#include "reports/run/child_process.hpp"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/run/child_keeper.hpp"
#include "reports/run/process_tree.hpp"

extern char** environ;

namespace cbc3d::reports {
namespace {

/// "8", "0.25".
std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

constexpr int kPollMilliseconds = 50;
constexpr std::size_t kTailBytes = 16384;

/// Environment of the child: ours, with the thread counts of the usual pools set, and where threads run.
std::vector<std::string> child_environment(int threads, bool bind_threads) {
  static constexpr std::array kThreadVariables{"OMP_NUM_THREADS", "OMP_THREAD_LIMIT",
                                               "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", "VTK_SMP_MAX_THREADS",
                                               "OPENBLAS_NUM_THREADS"};
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    const std::string key = text.substr(0, text.find('='));
    const bool replaced = threads > 0 && std::find(kThreadVariables.begin(), kThreadVariables.end(), key) !=
                                             kThreadVariables.end();
    if (!replaced && !(bind_threads && key == "OMP_PROC_BIND")) {
      environment.push_back(text);
    }
  }
  for (const char* key : kThreadVariables) {
    if (threads > 0) {
      environment.push_back(key + ("=" + std::to_string(threads)));
    }
  }
  if (bind_threads) {
    environment.emplace_back("OMP_PROC_BIND=true");
  }
  return environment;
}

/// The child's standard error: read as it comes, its end kept.
class Tail {
 public:
  explicit Tail(int descriptor) : descriptor_(descriptor) {}
  ~Tail() { ::close(descriptor_); }
  Tail(const Tail&) = delete;
  Tail& operator=(const Tail&) = delete;

  /// For poll(2), which passes over a negative one.
  [[nodiscard]] int descriptor() const { return open_ ? descriptor_ : -1; }
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

/// A command under its keeper, from its start to the end of both.
class RunningChild {
 public:
  explicit RunningChild(const ChildCommand& command)
      : command_(command),
        child_(start_kept_child(command.argv, child_environment(command.threads, command.bind_threads),
                                command.file_limit_bytes)),
        tail_(child_.errors) {}
  ~RunningChild() {
    let_go();
    ::close(child_.report);
    ::waitpid(child_.keeper, nullptr, 0);
  }
  RunningChild(const RunningChild&) = delete;
  RunningChild& operator=(const RunningChild&) = delete;

  /// Waits for the end, within the limits.
  ChildResult wait() {
    TreeMemory memory(child_.keeper);
    std::optional<ChildEnd> limit;
    while (!report_is_there()) {
      const std::int64_t used = memory.sample();
      peak_rss_bytes_ = std::max(peak_rss_bytes_, used);
      if (command_.memory_limit_bytes > 0 && used > command_.memory_limit_bytes) {
        limit = ChildEnd::out_of_memory;
      } else if (command_.timeout_s > 0 && watch_.seconds() > command_.timeout_s) {
        limit = ChildEnd::timeout;
      }
      if (limit) {
        let_go();
        break;
      }
    }
    ChildResult result = result_of(read_report());
    result.end = limit.value_or(result.end);
    return result;
  }

 private:
  /// Closing the lifeline makes the keeper end the command.
  void let_go() {
    if (child_.lifeline >= 0) {
      ::close(child_.lifeline);
      child_.lifeline = -1;
    }
  }

  bool report_is_there() {
    std::array<pollfd, 2> requests{pollfd{child_.report, POLLIN, 0}, pollfd{tail_.descriptor(), POLLIN, 0}};
    ::poll(requests.data(), requests.size(), kPollMilliseconds);
    tail_.read();
    return requests[0].revents != 0;
  }

  /// What the keeper says at its end; one that was killed says nothing.
  [[nodiscard]] std::optional<KeeperReport> read_report() const {
    KeeperReport report;
    ssize_t count = 0;
    do {
      count = ::read(child_.report, &report, sizeof report);
    } while (count < 0 && errno == EINTR);
    return count == sizeof report ? std::optional(report) : std::nullopt;
  }

  ChildResult result_of(const std::optional<KeeperReport>& report);

  const ChildCommand& command_;
  KeptChild child_;
  Stopwatch watch_;
  Tail tail_;
  std::int64_t peak_rss_bytes_ = 0;
};

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ChildResult RunningChild::result_of(const std::optional<KeeperReport>& report) {
  tail_.read();
  ChildResult result;
  result.wall_s = watch_.seconds();
  result.stderr_tail = tail_.text();
  result.peak_rss_bytes = peak_rss_bytes_;
  if (!report) {
    result.end = ChildEnd::signalled;
    result.signal = SIGKILL;
    return result;
  }
  result.cpu_s = seconds_of(report->usage.ru_utime) + seconds_of(report->usage.ru_stime);
  result.peak_rss_bytes =
      std::max(peak_rss_bytes_, static_cast<std::int64_t>(report->usage.ru_maxrss) * 1024);
  if (report->start_error != 0) {
    result.end = ChildEnd::not_started;
    result.stderr_tail = "cannot run '" + command_.argv.front() + "': " + std::strerror(report->start_error);
  } else if (WIFSIGNALED(report->wait_status)) {
    result.end = ChildEnd::signalled;
    result.signal = WTERMSIG(report->wait_status);
  } else {
    result.end = ChildEnd::exited;
    result.exit_code = WEXITSTATUS(report->wait_status);
  }
  return result;
}

}  // namespace

ChildResult run_child(const ChildCommand& command) {
  return RunningChild(command).wait();
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

namespace {

/// Terminals obey control characters: those of ASCII, and those that UTF-8 writes as C2 80 to C2 9F.
std::string without_controls(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const auto c = static_cast<unsigned char>(text[at]);
    const auto next = static_cast<unsigned char>(at + 1 < text.size() ? text[at + 1] : '\0');
    if (c == 0xC2 && next >= 0x80 && next < 0xA0) {
      ++at;
    } else if ((c >= ' ' && c != 0x7F) || c == '\n' || c == '\t') {
      kept += text[at];
    }
  }
  return kept;
}

}  // namespace

std::string printable(const std::string& text) {
  const std::string clean =
      nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  return without_controls(nlohmann::json::parse(clean).get<std::string>());
}

std::string failure_text(const ChildResult& child, double timeout_s, std::int64_t memory_limit_bytes) {
  std::string line = printable(last_line(child.stderr_tail));
  switch (child.end) {
    case ChildEnd::timeout:
      return "not done after " + number_text(timeout_s) + " s";
    case ChildEnd::out_of_memory:
      return "used more than " + number_text(static_cast<double>(memory_limit_bytes) / double(1 << 30)) +
             " GiB";
    case ChildEnd::signalled:
      if (child.signal == SIGXFSZ) {
        return "wrote a file beyond its limit; --file-limit sets that";
      }
      return signal_name(child.signal) + (line.empty() ? "" : "; last line: " + line);
    case ChildEnd::not_started:
      return line;
    case ChildEnd::exited:
      break;
  }
  return line.empty() ? "exit code " + std::to_string(child.exit_code) : line;
}

std::string signal_name(int signal) {
  const char* abbreviation = ::sigabbrev_np(signal);
  const std::string name =
      abbreviation != nullptr ? std::string("SIG") + abbreviation : "signal " + std::to_string(signal);
  const char* description = ::sigdescr_np(signal);
  return description != nullptr ? name + " (" + description + ")" : name;
}

}  // namespace cbc3d::reports
