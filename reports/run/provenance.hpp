// Where figures come from: this build and this machine.
#pragma once

#include <string>

#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// Version and git commit of this build and whether its sources differ from that, compiler and flags, library
/// versions, CPU, cores, memory, system, load and the time now (UTC).
Json provenance();

/// "2026-11-22T07:05:09Z".
std::string utc_now();

}  // namespace cbc3d::reports
