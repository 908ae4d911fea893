// Progress of long work: what the library reports as it goes on, and how its caller ends it early.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {

/// Is called when a step of the work begins: `stage` names the step, `fraction` in [0,1] is the share of the
/// whole work that is done. Returns whether the work shall go on; after false it ends by throwing Cancelled.
/// It is called in the thread that called the work, never inside a parallel region.
using ProgressObserver = std::function<bool(std::string_view stage, double fraction)>;

/// The library's side of an observer. TerminalProgress is one that draws a bar.
class Progress {
 public:
  /// Nothing observes the work.
  Progress() = default;
  /// An empty `observer` is none.
  explicit Progress(ProgressObserver observer) : observer_(std::move(observer)) {}

  /// Announces the step that begins now. Throws Cancelled when the observer returns false.
  void step(std::string_view stage, double fraction) const {
    if (observer_ && !observer_(stage, fraction)) {
      throw Cancelled("cancelled before the step '" + std::string(stage) + "'");
    }
  }

 private:
  ProgressObserver observer_;
};

}  // namespace cbc3d
