// TetGen behind a surface net of the label image.
#pragma once

#include <vector>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// The only mesher of this folder.
std::vector<Adapter> tetgen_adapters();

}  // namespace cbc3d::baselines
