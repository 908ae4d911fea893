// The resident memory of a process group, from /proc.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <vector>

namespace cbc3d::reports {

/// Samples how much memory the members of a process group hold together.
class GroupMemory {
 public:
  explicit GroupMemory(pid_t group) : group_(group) {}
  /// Resident memory of the group now, bytes. Looks for new members only at every fifth call, since going
  /// through all of /proc takes milliseconds.
  std::int64_t sample();

 private:
  pid_t group_;
  int calls_ = 0;
  std::vector<pid_t> members_;
};

}  // namespace cbc3d::reports
