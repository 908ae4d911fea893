// Errors that end a command, each with the exit code that the command then returns.
#pragma once

#include <stdexcept>
#include <string>

namespace cbc3d {

/// Bad usage or bad input: the message names the file or option, the value found and the remedy. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A job that could not be finished although its input was good. Exit code 3.
class JobError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr int kExitSuccess = 0;
inline constexpr int kExitGateFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitJobFailed = 3;

}  // namespace cbc3d
