// Processes that a test has started indirectly, by the files in which they note their ids.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace cbc3d::reports::test {

/// No time limit for what a test starts: a machine may be as busy as it likes. What hangs is ended by ctest.
inline constexpr double kNoTimeLimit = 0;

/// True when no such process is there, or only a zombie that nobody waits for.
inline bool is_gone(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string id, name, state;
  return !(stat >> id >> name >> state) || state == "Z";
}

/// Waits until the process is gone.
inline void await_end(pid_t process) {
  while (!is_gone(process)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

/// Waits until the file has a process id.
inline pid_t await_process(const std::filesystem::path& file) {
  pid_t process = 0;
  while (!(std::ifstream(file) >> process)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return process;
}

}  // namespace cbc3d::reports::test
