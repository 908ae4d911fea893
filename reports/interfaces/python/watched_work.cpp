#include "reports/interfaces/python/watched_work.hpp"

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <vector>

namespace cbc3d::python {
namespace {

namespace py = pybind11;

/// Threads whose caller no longer waits, and whether each has ended.
struct LeftBehind {
  std::thread thread;
  std::function<bool()> has_ended;
};

std::vector<LeftBehind>& left_behind() {
  static std::vector<LeftBehind> all;
  return all;
}

bool answer_of(const py::object& callback, const Meeting::Question& question) {
  if (callback.is_none()) return true;
  const py::object answer = callback(question.stage, question.fraction);
  return answer.is_none() || answer.cast<bool>();
}

std::optional<Meeting::Question> next_question(Meeting& meeting) {
  const py::gil_scoped_release released;
  return meeting.question();
}

void join(std::thread& worker) {
  const py::gil_scoped_release released;
  worker.join();
}

}  // namespace

bool Meeting::ask(std::string_view stage, double fraction) {
  // The work's threads have heaps of their own, which keep what a step has freed; the next step has other
  // threads' to fill.
  ::malloc_trim(0);
  std::unique_lock lock(mutex_);
  if (left_) return false;
  question_ = Question{std::string(stage), fraction};
  answer_.reset();
  changed_.notify_all();
  changed_.wait(lock, [this] { return answer_ || left_; });
  return !left_ && answer_.value_or(false);
}

void Meeting::end() {
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

std::optional<Meeting::Question> Meeting::question() {
  constexpr std::chrono::milliseconds kPatience(50);
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kPatience, [this] { return question_ || ended_; });
  return std::exchange(question_, std::nullopt);
}

void Meeting::answer(bool goes_on) {
  const std::lock_guard lock(mutex_);
  answer_ = goes_on;
  changed_.notify_all();
}

void Meeting::leave() {
  const std::lock_guard lock(mutex_);
  left_ = true;
  changed_.notify_all();
}

bool Meeting::has_ended() {
  const std::lock_guard lock(mutex_);
  return ended_;
}

void wait_for(const std::shared_ptr<Meeting>& meeting, std::thread& worker, const py::object& callback) {
  while (!meeting->has_ended()) {
    const auto question = next_question(*meeting);
    if (PyErr_CheckSignals() != 0) {
      meeting->leave();
      left_behind().push_back({std::move(worker), [meeting] { return meeting->has_ended(); }});
      throw py::error_already_set();
    }
    if (!question) continue;
    try {
      meeting->answer(answer_of(callback, *question));
    } catch (...) {
      meeting->answer(false);
      join(worker);
      throw;
    }
  }
  join(worker);
}

int works_left_behind() {
  const auto& all = left_behind();
  return static_cast<int>(
      std::count_if(all.begin(), all.end(), [](const LeftBehind& work) { return !work.has_ended(); }));
}

void wait_for_works_left_behind() {
  for (LeftBehind& work : left_behind()) join(work.thread);
  left_behind().clear();
}

}  // namespace cbc3d::python
