// Several workers on the jobs of one refiner: begging for work, backing off, and the end of all (GPL, as the
// refiner is).
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "baselines/podm/refiner.hpp"

namespace cbc3d::baselines::podm {

template <typename Concurrency>
class Crew {
 public:
  using Worker = typename Refiner<Concurrency>::Worker;
  using Job = typename Refiner<Concurrency>::Job;

  Crew(Refiner<Concurrency>& refiner, std::vector<Worker>& workers) : refiner_(refiner), workers_(workers) {}

  /// Works until no worker has a job. The first worker begins alone; the others come when there is enough for
  /// all, for in a small triangulation they would lock the same tets. Rethrows what a worker threw.
  void work() {
    Worker& first = workers_.front();
    const std::size_t enough = kJobsToShare * workers_.size();
    while (!first.idle() && (workers_.size() == 1 || first.size() < enough)) refiner_.step(first);
    if (first.idle()) return;
    share_out();
    run_all();
  }

 private:
  static constexpr std::size_t kJobsToShare = 2000;
  static constexpr std::size_t kMostGiven = 512;
  static constexpr std::size_t kKept = 16;
  struct Gift {
    std::size_t queue;
    Job job;
  };

  // The first worker's jobs in slabs across the longest side, so that workers begin apart.
  void share_out() {
    Worker& first = workers_.front();
    for (std::size_t queue = 0; queue < kQueues; ++queue) {
      auto& all = first.jobs[queue];
      const int axis = longest_axis(all);
      std::stable_sort(all.begin(), all.end(),
                       [&](const Job& a, const Job& b) { return a.key[axis] < b.key[axis]; });
      const std::size_t count = all.size();
      std::deque<Job> own;
      for (std::size_t n = 0; n < count; ++n) {
        const std::size_t number = n * workers_.size() / count;
        (number == 0 ? own : workers_[number].jobs[queue]).push_back(all[n]);
      }
      all = std::move(own);
    }
  }

  static int longest_axis(const std::deque<Job>& jobs) {
    if (jobs.empty()) return 0;
    Vec3 low = jobs.front().key, high = low;
    for (const Job& job : jobs) {
      for (int a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], job.key[a]);
        high[a] = std::max(high[a], job.key[a]);
      }
    }
    const Vec3 extent = high - low;
    return extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  }

  void run_all() {
    std::vector<std::thread> threads;
    threads.reserve(workers_.size());
    for (Worker& worker : workers_) threads.emplace_back([this, &worker] { run_guarded(worker); });
    for (std::thread& thread : threads) thread.join();
    if (failure_) std::rethrow_exception(failure_);
  }

  void run_guarded(Worker& worker) {
    try {
      run(worker);
    } catch (...) {
      const std::lock_guard guard(mutex_);
      if (!failure_) failure_ = std::current_exception();
      finished_ = true;
      changed_.notify_all();
    }
  }

  void run(Worker& worker) {
    std::minstd_rand random(static_cast<unsigned>(worker.number) + 1);
    int blocked_in_a_row = 0;
    while (!finished_) {
      if (worker.idle()) {
        if (!beg(worker)) return;
        continue;
      }
      if (refiner_.step(worker) == Attempt::kBlocked) {
        back_off(++blocked_in_a_row, random);
      } else {
        blocked_in_a_row = 0;
      }
      if (beggars_ > 0) give(worker);
    }
  }

  // The worker whose lock was in the way needs a moment; it needs it longer the more often it was there.
  static void back_off(int blocked_in_a_row, std::minstd_rand& random) {
    constexpr int kPatience = 4, kMostDoublings = 9;
    if (blocked_in_a_row < kPatience) {
      std::this_thread::yield();
      return;
    }
    const unsigned most_us = 2U << std::min(blocked_in_a_row - kPatience, kMostDoublings);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % most_us));
  }

  // Waits for others to give jobs; false when nobody has any.
  bool beg(Worker& worker) {
    std::unique_lock lock(mutex_);
    ++beggars_;
    if (gifts_.empty() && beggars_ == workers_.size()) {
      finished_ = true;
      changed_.notify_all();
      return false;
    }
    changed_.wait(lock, [&] { return finished_ || !gifts_.empty(); });
    if (finished_) return false;
    --beggars_;
    const std::size_t taken = std::min(gifts_.size(), kMostGiven);
    for (std::size_t n = 0; n < taken; ++n) {
      worker.jobs[gifts_.back().queue].push_back(gifts_.back().job);
      gifts_.pop_back();
    }
    return true;
  }

  // Half of the worker's most urgent queue, which it would come to last.
  void give(Worker& worker) {
    const auto queue = std::find_if(worker.jobs.begin(), worker.jobs.end(),
                                    [](const auto& jobs) { return jobs.size() > kKept; });
    if (queue == worker.jobs.end()) return;
    const std::lock_guard guard(mutex_);
    if (!gifts_.empty()) return;
    const std::size_t given = std::min(queue->size() / 2, kMostGiven);
    for (std::size_t n = 0; n < given; ++n) {
      gifts_.push_back({static_cast<std::size_t>(queue - worker.jobs.begin()), queue->back()});
      queue->pop_back();
    }
    changed_.notify_one();
  }

  Refiner<Concurrency>& refiner_;
  std::vector<Worker>& workers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Gift> gifts_;
  std::atomic<std::size_t> beggars_{0};
  std::atomic<bool> finished_{false};
  std::exception_ptr failure_;
};

}  // namespace cbc3d::baselines::podm
