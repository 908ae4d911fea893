// A kind of fault: how often, and where first.
#pragma once

#include <cstddef>
#include <cstdint>

namespace cbc3d::metrics {

struct CountedFault {
  std::int64_t count = 0;
  std::size_t first = 0;  ///< number of the first vertex or cell that has it; meaningless when count is 0
};

}  // namespace cbc3d::metrics
