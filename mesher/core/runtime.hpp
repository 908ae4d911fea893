// What every command shares: the thread count, and the seconds and memory that it has used.
#pragma once

#include <chrono>
#include <cstdint>

namespace cbc3d {

/// Sets the thread count of OpenMP, ITK, VTK and, where they are linked in, the other pools. 0 means all
/// cores. Returns the count in force.
int set_thread_count(int threads);

/// Sets environment variables by which OpenMP's waiting threads spin briefly and then sleep, unless they are
/// set already. On a busy machine, threads that spin for long delay the very thread they wait for, several
/// times over; threads that sleep at once are woken up a thousand times a second. OpenMP reads the variables
/// when it is loaded. Returns whether something was set.
bool choose_sleeping_waits();

/// Calls choose_sleeping_waits() and, when something was set, starts the program once more, so that OpenMP
/// reads it. Call it first in main(). Does nothing when the program cannot be started again.
void let_waiting_threads_sleep(char** argv);

/// Opens those of the standard streams that are closed to nothing. Otherwise the next file that is opened
/// takes their place, and what is said on them goes into it. Call it early in main().
void open_standard_streams();

/// Makes the process keep freed memory for its next allocations. Memory that is returned comes back page by
/// page, each cleared by the system, which is serial work. Call it early in main().
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

/// Those of them that the system spent for this process. Most are the first touches of memory pages, whose
/// price is the machine's: between two machines it differs by more than the price of computing does.
double process_system_cpu_seconds();

/// Peak resident set size of this process so far, bytes.
std::int64_t process_peak_rss_bytes();

}  // namespace cbc3d
