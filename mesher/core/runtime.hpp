// What every command shares: thread count, seconds and memory used.
#pragma once

#include <chrono>
#include <cstdint>

namespace cbc3d {

/// Sets the thread count of OpenMP, ITK, VTK and, where they are linked in, the other pools. 0 means all
/// cores. Returns the count in force.
int set_thread_count(int threads);

/// Writes into the environment that OpenMP's waiting threads sleep when the next work does not come at once,
/// unless it says already how they wait: on a machine that does other things too, spinning threads hold up
/// the one they wait for, several times over; but threads that sleep at once are woken up a thousand times a
/// second. OpenMP reads this when it is loaded. Returns whether something was written.
bool choose_sleeping_waits();

/// choose_sleeping_waits(), and where something was written, the program started once more, so that OpenMP
/// reads it; call it first in main(). Does nothing where that cannot be done.
void let_waiting_threads_sleep(char** argv);

/// Lets the process keep freed memory for what it asks for next, instead of handing blocks back that it then
/// gets again page by page, each to be cleared by the system: that is serial work. Call it early in main().
void keep_freed_memory();

/// Wall-clock seconds since construction.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// CPU seconds (user + system, all threads) of this process so far.
double process_cpu_seconds();

/// Peak resident set size of this process so far, bytes.
std::int64_t process_peak_rss_bytes();

}  // namespace cbc3d
