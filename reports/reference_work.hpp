// A fixed piece of work, whose time says how fast this machine is just now.
#pragma once

namespace cbc3d::reports {

/// CPU seconds that this thread takes for work like a mesher's: look-ups all over tens of megabytes, and
/// geometry in doubles. The smallest of three goes, about .1 s in all. Times of jobs are compared between
/// machines, and on a machine under load, as ratios to it.
double reference_cpu_seconds();

}  // namespace cbc3d::reports
