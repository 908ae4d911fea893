#include "baselines/registry.hpp"

#include <algorithm>

#include "baselines/cbc3d/adapter.hpp"
#include "baselines/cgal/adapter.hpp"
#include "baselines/tetgen/adapter.hpp"

namespace cbc3d::baselines {

const std::vector<Adapter>& registry() {
  static const std::vector<Adapter> adapters{cbc3d_adapter(), cbc3d_paper_adapter(),   cbc3d_mixed_adapter(),
                                             cgal_adapter(),  cgal_parallel_adapter(), tetgen_adapter()};
  return adapters;
}

const Adapter* find_adapter(const std::string& name) {
  const auto& all = registry();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Adapter& a) { return a.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace cbc3d::baselines
