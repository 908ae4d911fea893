// Work in a child process, for libraries that can take their process down with them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cbc3d::baselines {

/// How a child process ended.
struct ChildResult {
  std::vector<std::byte> output;  ///< what it sent back
  int exit_code = 0;              ///< when it ended by itself
  int signal = 0;                 ///< the signal that killed it; 0: none
};

/// Exit codes that report an exception which nothing caught.
inline constexpr int kChildOutOfMemory = 100;
inline constexpr int kChildThrew = 101;
inline constexpr int kChildThrewNumber = 110;  ///< plus the number, for `throw 3` and the like (below 100)

/// Forks, calls `work` in the child with a function that sends bytes back, and waits. The child's standard
/// output and error are dropped. `work` runs in a thread of its own with no handler above it, so that an
/// exception ends the child on the spot, without unwinding the stack. Throws JobError when no child can be
/// made.
using Send = std::function<void(const void* data, std::size_t bytes)>;
ChildResult run_in_child(const std::function<void(const Send&)>& work);

}  // namespace cbc3d::baselines
