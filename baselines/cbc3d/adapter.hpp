// CBC3D itself, by its command.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter cbc3d_adapter();        ///< the default preset
Adapter cbc3d_paper_adapter();  ///< the preset with the paper's settings
Adapter cbc3d_mixed_adapter();  ///< the paper's preset with mixed elements

}  // namespace cbc3d::baselines
