// The one list of meshers that the bench can run.
#pragma once

#include <string>
#include <vector>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// Every mesher, in the order in which tables show them.
const std::vector<Adapter>& registry();

/// The mesher of that name, or nullptr.
const Adapter* find_adapter(const std::string& name);

}  // namespace cbc3d::baselines
