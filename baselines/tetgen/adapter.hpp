// TetGen behind a surface net of the label image.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter tetgen_adapter();

/// The same as a list.
std::vector<Adapter> tetgen_adapters();

}  // namespace cbc3d::baselines
