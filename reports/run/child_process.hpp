// A command run as a child process under a time and a memory limit, with everything it starts ended with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cbc3d::reports {

struct ChildCommand {
  std::vector<std::string> argv;  ///< program (a path, or a name searched for in PATH) and its arguments
  int threads = 0;                ///< value of OMP_NUM_THREADS and the like; 0 leaves the environment alone
  double timeout_s = 0;           ///< wall-clock limit, s; 0: none
  std::int64_t memory_limit_bytes =
      0;                      ///< limit on the resident memory of the command and all it started; 0: none
  bool bind_threads = false;  ///< OMP_PROC_BIND: OpenMP's threads stay each on a core of its own
  std::int64_t file_limit_bytes = 0;  ///< of each file that the command writes (RLIMIT_FSIZE); 0: none
};

enum class ChildEnd {
  exited,         ///< by itself; see exit_code
  signalled,      ///< by a signal that was not ours; see signal
  timeout,        ///< killed at the time limit
  out_of_memory,  ///< killed at the memory limit
  not_started     ///< the program could not be executed; stderr_tail says why
};

struct ChildResult {
  ChildEnd end = ChildEnd::not_started;
  int exit_code = 0;
  int signal = 0;
  double wall_s = 0;
  double cpu_s = 0;  ///< user + system, of the child and the children it waited for
  std::int64_t peak_rss_bytes =
      0;                    ///< the larger of the kernel's figure and the sampled sum of all processes
  std::string stderr_tail;  ///< the last 16 KiB that the child wrote to standard error
};

/// Runs a command in a process group of its own and waits for it; standard output is dropped. Everything that
/// the command started, even in other groups and sessions, is killed when it ends or meets a limit, and when
/// this process dies of any signal, SIGKILL too. One child at a time: not to be called from two threads.
/// Throws JobError when no process can be made at all.
ChildResult run_child(const ChildCommand& command);

/// The last line of `text` that is not blank; empty if there is none.
std::string last_line(const std::string& text);

/// Why a child did not end with success, in one line of UTF-8: the limit that it met, its signal, or the last
/// line that it wrote to standard error, or else its exit code.
std::string failure_text(const ChildResult& child, double timeout_s, std::int64_t memory_limit_bytes);

/// A text that a program printed, which may be anything, as UTF-8 without control characters but ends of
/// lines and tabs.
std::string printable(const std::string& text);

/// "SIGSEGV (Segmentation fault)".
std::string signal_name(int signal);

}  // namespace cbc3d::reports
