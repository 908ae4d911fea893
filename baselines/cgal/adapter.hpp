// CGAL Mesh_3, sequential and parallel.
#pragma once

#include <vector>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

/// The sequential mesher and the parallel one, which does not repeat.
std::vector<Adapter> cgal_adapters();

}  // namespace cbc3d::baselines
