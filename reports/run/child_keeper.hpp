// The process between the runner and a job's command, so that nothing of the job outlives either of them.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace cbc3d::reports {

/// What the keeper says when the command and everything that it started are gone.
struct KeeperReport {
  int start_error = 0;  ///< errno of a command that could not be executed; 0: it was
  int wait_status = 0;  ///< of the command, as wait(2) gives it
  rusage usage{};       ///< of the command and the children it waited for
};

/// A command under its keeper. The keeper adopts every process that the command leaves behind, whatever group
/// or session that went to. When the command ends, or the lifeline is closed (by this process, or because it
/// was killed), it kills all that is left, reports and ends.
struct KeptChild {
  pid_t keeper = -1;
  int errors = -1;    ///< read end of the command's standard error, not blocking
  int report = -1;    ///< read end, gets one KeeperReport
  int lifeline = -1;  ///< write end; closing it ends the command
};

/// Starts `argv` with the environment `variables` ("KEY=VALUE"); it writes no file of more than
/// `file_limit_bytes`, where that is not 0. One at a time: a second keeper would hold the first one's
/// lifeline open. Throws JobError when no process can be made.
KeptChild start_kept_child(std::vector<std::string> argv, std::vector<std::string> variables,
                           std::int64_t file_limit_bytes = 0);

}  // namespace cbc3d::reports
