// Long work without the interpreter's lock, which Ctrl-C and a callback can end.
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "mesher/core/progress.hpp"

namespace cbc3d::python {

/// Calls Python's callback with the stage and the fraction that is done; None is no callback. The work ends
/// when the callback returns False or raises, and when a signal's handler raises, as that of Ctrl-C does.
class Watcher {
 public:
  explicit Watcher(pybind11::object callback) : callback_(std::move(callback)) {}

  /// For the library, which calls it without the lock.
  bool observe(std::string_view stage, double fraction);

  /// Raises what the callback or the handler raised, if anything; needs the lock.
  void rethrow() const {
    if (raised_) {
      std::rethrow_exception(raised_);
    }
  }

 private:
  bool goes_on(std::string_view stage, double fraction);
  pybind11::object callback_;
  std::exception_ptr raised_;
};

/// Runs `work(observer)` without the interpreter's lock. Throws Cancelled when the callback returned False.
template <typename Work>
auto watched(const pybind11::object& callback, const Work& work) {
  Watcher watcher(callback);
  try {
    const pybind11::gil_scoped_release released;
    return work(ProgressObserver(
        [&watcher](std::string_view stage, double fraction) { return watcher.observe(stage, fraction); }));
  } catch (const Cancelled&) {
    watcher.rethrow();
    throw;
  }
}

}  // namespace cbc3d::python
