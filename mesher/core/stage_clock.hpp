// Seconds of named stages of one piece of work: the meshing, the deformation, another mesher's run.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/runtime.hpp"

namespace cbc3d {

/// Names of stages with their wall-clock seconds, in the order in which they were first begun.
using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Adds up the wall-clock seconds of stages by their name. A stage that runs again counts on under its name.
class StageClock {
 public:
  /// Runs `stage` as part of the stage `name` and returns what it returns. Its seconds count when it throws
  /// too. Stages that are timed inside another count in both, and twice in the totals.
  template <typename Stage>
  auto time(const std::string& name, const Stage& stage) {
    const Timer timer{*this, begin(name)};
    return stage();
  }

  /// Ends the stage that start() began, if one runs, and begins `name`.
  void start(const std::string& name);
  /// Ends the stage that start() began, if one runs.
  void stop();

  [[nodiscard]] const StageSeconds& seconds() const { return seconds_; }
  /// Wall-clock seconds of all stages together.
  [[nodiscard]] double total_seconds() const;
  /// CPU seconds (user and system, all threads) of this process in all stages together.
  [[nodiscard]] double cpu_seconds() const { return cpu_seconds_; }
  /// Those of them that the system spent.
  [[nodiscard]] double system_cpu_seconds() const { return system_cpu_seconds_; }

 private:
  struct Running {
    std::size_t stage;
    double cpu_before, system_cpu_before;
    Stopwatch watch = {};
  };
  struct Timer {
    StageClock& clock;
    Running running;
    ~Timer() { clock.end(running); }
  };

  [[nodiscard]] Running begin(const std::string& name);
  void end(const Running& running);

  StageSeconds seconds_;
  double cpu_seconds_ = 0, system_cpu_seconds_ = 0;
  std::optional<Running> running_;
};

}  // namespace cbc3d
