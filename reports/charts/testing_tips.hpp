// What the marks of a chart say of themselves, for tests.
#pragma once

#include <string>

namespace cbc3d::reports::test {

/// The tip of the mark whose first line is `owner`, its lines apart by "&#10;"; empty where there is none.
inline std::string tip_of(const std::string& svg, const std::string& owner) {
  const std::string begin = "<title>" + owner + "&#10;";
  const std::size_t at = svg.find(begin);
  return at == std::string::npos ? "" : svg.substr(at, svg.find("</title>", at) - at);
}

}  // namespace cbc3d::reports::test
