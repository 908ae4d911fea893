#include "mesher/core/stage_clock.hpp"

#include <algorithm>
#include <numeric>

namespace cbc3d {

void StageClock::start(const std::string& name) {
  stop();
  running_ = begin(name);
}

void StageClock::stop() {
  if (running_) {
    end(*running_);
    running_.reset();
  }
}

double StageClock::total_seconds() const {
  return std::accumulate(seconds_.begin(), seconds_.end(), 0.0,
                         [](double sum, const auto& stage) { return sum + stage.second; });
}

StageClock::Running StageClock::begin(const std::string& name) {
  const auto known =
      std::find_if(seconds_.begin(), seconds_.end(), [&](const auto& stage) { return stage.first == name; });
  const auto stage = static_cast<std::size_t>(known - seconds_.begin());
  if (known == seconds_.end()) {
    seconds_.emplace_back(name, 0.0);
  }
  return {stage, process_cpu_seconds(), process_system_cpu_seconds()};
}

void StageClock::end(const Running& running) {
  seconds_[running.stage].second += running.watch.seconds();
  cpu_seconds_ += process_cpu_seconds() - running.cpu_before;
  system_cpu_seconds_ += process_system_cpu_seconds() - running.system_cpu_before;
}

}  // namespace cbc3d
