// CBC3D itself, by its command.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// cbc3d (the default preset), cbc3d-paper (the preset with the paper's settings) and cbc3d-mixed (the same
/// with mixed elements). Their parameters are those that `cbc3d mesh --describe-options` prints for the
/// preset.
std::vector<Adapter> cbc3d_adapters();

}  // namespace cbc3d::baselines
