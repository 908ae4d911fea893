// A figure that is drawn from numbers.
#pragma once

#include <string>

namespace cbc3d::reports {

struct Figure {
  std::string name;   ///< file name without extension
  std::string title;  ///< one line
  std::string svg;
};

}  // namespace cbc3d::reports
