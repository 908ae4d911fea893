// PODM as the bench sees it.
#pragma once

#include <vector>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// The only mesher of this folder.
std::vector<Adapter> podm_adapters();

}  // namespace cbc3d::baselines
