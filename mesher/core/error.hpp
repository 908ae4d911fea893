// Errors that end a command, each with the exit code that the command then returns.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace cbc3d {

/// Bad usage or bad input: the message names the file or parameter, the value found and the remedy. Exit code
/// 2.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message, std::string parameter = {})
      : std::runtime_error(message), parameter_(std::move(parameter)) {}
  /// The parameter at fault, by the name of its field ("lattice_spacing_mm"); empty where it is not one.
  [[nodiscard]] const std::string& parameter() const { return parameter_; }

 private:
  std::string parameter_;
};

/// A job that could not be finished although its input was good. Exit code 3.
class JobError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Work that ended early because its ProgressObserver returned false.
class Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr int kExitSuccess = 0;
inline constexpr int kExitGateFailed = 1;
inline constexpr int kExitBadInput = 2;
inline constexpr int kExitJobFailed = 3;

}  // namespace cbc3d
