// Lattice cleaving as a mesher of the bench.
#pragma once

#include <vector>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// The only mesher of this folder.
std::vector<Adapter> cleaver_adapters();

}  // namespace cbc3d::baselines
