#include "reports/tables/table_input.hpp"

#include <algorithm>

namespace cbc3d::reports {

const cases::Case* find_case(const std::vector<cases::Case>& cases, const std::string& name) {
  const auto found =
      std::find_if(cases.begin(), cases.end(), [&](const cases::Case& c) { return c.name == name; });
  return found == cases.end() ? nullptr : &*found;
}

}  // namespace cbc3d::reports
