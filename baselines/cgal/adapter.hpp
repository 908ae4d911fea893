// CGAL Mesh_3, sequential and parallel.
#pragma once

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {

Adapter cgal_adapter();
Adapter cgal_parallel_adapter();

/// Both, in the order of the tables.
std::vector<Adapter> cgal_adapters();

}  // namespace cbc3d::baselines
