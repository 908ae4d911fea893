// The resident memory of a process's descendants, from /proc.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace cbc3d::reports {

/// Samples how much memory the descendants of a process hold together; the process itself is not counted.
class TreeMemory {
 public:
  explicit TreeMemory(pid_t root) : root_(root) {}
  /// Resident memory of the descendants now, bytes. Looks for new ones only at every fifth call, since going
  /// through all of /proc takes milliseconds.
  std::int64_t sample();

 private:
  pid_t root_;
  int calls_ = 0;
  std::vector<pid_t> members_;
};

}  // namespace cbc3d::reports
