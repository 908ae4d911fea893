// Work in a child process with limits, so that a library that fails on a damaged file takes nothing down.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace cbc3d {

struct ChildLimits {
  std::uint64_t memory_bytes = 0;  ///< beyond what the parent has at the start
  unsigned cpu_seconds = 1;
};

/// Sends bytes to the parent; it ends the child when the parent is gone.
class ChildOutput {
 public:
  explicit ChildOutput(int pipe) : pipe_(pipe) {}
  void write(std::span<const std::byte> bytes) const;

 private:
  int pipe_;
};

/// A copy of this process (fork) that does `work`, which must not use OpenMP, and sends what it finds. Its
/// standard error is closed. Throws JobError where the system gives no process.
class ChildProcess {
 public:
  ChildProcess(const ChildLimits& limits, const std::function<void(const ChildOutput&)>& work);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Fills `bytes` with the next that the child sends; false where it ended before.
  [[nodiscard]] bool read(std::span<std::byte> bytes);
  /// Waits for the child's end: empty when it came to its end, otherwise what ended it ("signal 11").
  std::string wait();

 private:
  pid_t child_ = -1;
  int pipe_ = -1;
};

}  // namespace cbc3d
