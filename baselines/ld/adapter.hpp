// LD as the bench sees it.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter ld_adapter();

/// The same as a list.
std::vector<Adapter> ld_adapters();

}  // namespace cbc3d::baselines
