#include "baselines/registry.hpp"

#include <algorithm>

// One line per folder, in the order of the tables: FOLDER_adapters() gives the adapters of baselines/FOLDER.
#define CBC3D_MESHER_FOLDERS(FOLDER) \
  FOLDER(cbc3d)                      \
  FOLDER(cgal)                       \
  FOLDER(cleaver)                    \
  FOLDER(ld)                         \
  FOLDER(podm)                       \
  FOLDER(tetgen)

namespace cbc3d::baselines {

#define CBC3D_DECLARE(folder) std::vector<Adapter> folder##_adapters();
CBC3D_MESHER_FOLDERS(CBC3D_DECLARE)
#undef CBC3D_DECLARE

namespace {

std::vector<Adapter> adapters_of_all_folders() {
  std::vector<Adapter> all;
  const auto append = [&](const std::vector<Adapter>& adapters) {
    all.insert(all.end(), adapters.begin(), adapters.end());
  };
#define CBC3D_APPEND(folder) append(folder##_adapters());
  CBC3D_MESHER_FOLDERS(CBC3D_APPEND)
#undef CBC3D_APPEND
  return all;
}

}  // namespace

const std::vector<Adapter>& registry() {
  static const std::vector<Adapter> adapters = adapters_of_all_folders();
  return adapters;
}

const Adapter* find_adapter(const std::string& name) {
  const auto& all = registry();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Adapter& a) { return a.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace cbc3d::baselines
