// Checks that hold at any thread count.
#pragma once

#include <omp.h>

namespace cbc3d::testing {

/// Runs a check at several thread counts.
template <typename Check>
void at_thread_counts(const Check& check) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3, 8}) {
    omp_set_num_threads(threads);
    check();
  }
  omp_set_num_threads(before);
}

}  // namespace cbc3d::testing
