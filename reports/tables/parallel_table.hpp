// How much faster every stage gets with more threads, and what of it stays serial.
#pragma once

#include "reports/sweep/sweep.hpp"
#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// The serial share s of a work that `threads` threads do `speed_up` times as fast as one: by Amdahl's law
/// speed_up = 1 / (s + (1 - s) / threads). 0 where it is more than as many times as fast as there are
/// threads, 1 where it is slower than one.
double serial_share(double speed_up, int threads);

/// Table `sweep_parallel`, of cases and meshers with samples of one thread and of more: a row for the whole
/// job, one with reading and writing, and one per stage. Columns: median seconds at each thread count, share
/// of the one-thread time, then for each count above one the speed-up and the serial share; last the speed-up
/// asked at two threads, which is not asked of stages below 5 % of the time. What misses it is marked.
/// Without rows when there is nothing to compare.
Table parallel_table(const std::vector<SweepPoint>& points);

/// The same of a run; without rows when the run is no sweep.
Table sweep_parallel_table(const TableInput& input);

}  // namespace cbc3d::reports
