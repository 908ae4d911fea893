// TetGen behind a surface net of the label image.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter tetgen_adapter();

}  // namespace cbc3d::baselines
