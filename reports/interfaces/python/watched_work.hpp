// Long work without the interpreter's lock, which Ctrl-C and a callback can end.
#pragma once

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <utility>

#include "mesher/core/progress.hpp"

namespace cbc3d::python {

/// Where the thread that works and the thread that waits for it meet.
class Meeting {
 public:
  /// For the work: asks whether it shall go on, and waits for the answer.
  bool ask(std::string_view stage, double fraction);
  /// For the work, at its end.
  void end();

  /// For the thread that waits, without the interpreter's lock: a question, or nothing where the work has
  /// ended or a twentieth of a second has passed.
  struct Question {
    std::string stage;
    double fraction = 0;
  };
  std::optional<Question> question();
  void answer(bool goes_on);
  /// Leaves the work behind: it goes on to its next step and ends there.
  void leave();
  [[nodiscard]] bool has_ended();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Question> question_;
  std::optional<bool> answer_;
  bool left_ = false, ended_ = false;
};

/// Calls Python's callback with the stage and the fraction that is done; None is no callback. Waits for the
/// end of the work: it ends at its next step when the callback returns False or raises. When a signal's
/// handler raises, as that of Ctrl-C does, this raises at once and the work is left behind. Needs the
/// interpreter's lock, which it frees while it waits.
void wait_for(const std::shared_ptr<Meeting>& meeting, std::thread& worker, const pybind11::object& callback);

/// How many works that were left behind have not ended.
int works_left_behind();

/// Waits for the end of works that were left behind, which end at their next step.
void wait_for_works_left_behind();

/// Runs `work(observer)` in a thread of its own and returns what it returns. The work owns what it uses, and
/// that is nothing of Python's, for it may outlive the call. Throws Cancelled when the callback returned
/// False.
template <typename Work>
auto watched(const pybind11::object& callback, Work work) {
  using Result = std::invoke_result_t<Work&, const ProgressObserver&>;
  struct Shared {
    explicit Shared(Work given) : work(std::move(given)) {}
    Work work;
    std::shared_ptr<Meeting> meeting = std::make_shared<Meeting>();
    std::promise<Result> result;
  };
  const auto shared = std::make_shared<Shared>(std::move(work));
  std::thread worker([shared] {
    try {
      const ProgressObserver observer([&shared](std::string_view stage, double fraction) {
        return shared->meeting->ask(stage, fraction);
      });
      shared->result.set_value(shared->work(observer));
    } catch (...) {
      shared->result.set_exception(std::current_exception());
    }
    shared->meeting->end();
  });
  wait_for(shared->meeting, worker, callback);
  return shared->result.get_future().get();
}

}  // namespace cbc3d::python
