// A fixed piece of work, whose time says how fast this machine is just now.
#pragma once

namespace cbc3d::reports {

/// CPU seconds that a thread takes for work like a mesher's: look-ups all over the near caches, and geometry
/// in doubles. `threads` of them do it side by side, as the job's threads do, since cores that share
/// caches and execution units slow each other down: the mean of each thread's best of four goes, about .1 s
/// in all. Times of jobs are compared between machines, and on a machine under load, as ratios to it.
double reference_cpu_seconds(int threads);

}  // namespace cbc3d::reports
