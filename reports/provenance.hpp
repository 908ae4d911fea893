// Where figures come from: this build and this machine.
#pragma once

#include "reports/result.hpp"

namespace cbc3d::reports {

/// Version and git commit of this build, compiler, library versions, CPU, cores, memory and the time now
/// (UTC).
Json provenance();

}  // namespace cbc3d::reports
