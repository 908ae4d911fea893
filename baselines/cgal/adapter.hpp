// CGAL Mesh_3, sequential and parallel.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter cgal_adapter();
Adapter cgal_parallel_adapter();

}  // namespace cbc3d::baselines
