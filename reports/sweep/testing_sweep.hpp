// Lines of a sweep with known times, for tests.
#pragma once

#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// One sample of the mesher cbc3d on the case box.
inline Json sweep_line(int threads, int repeat, double seconds) {
  Json line = empty_result();
  line["case"] = "box";
  line["mesher"] = "cbc3d";
  line["threads"] = threads;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["time_s"] = {{"mesh", seconds},
                    {"cpu", seconds},
                    {"stages", {{"lattice", seconds / 4}, {"deformation", seconds / 2}}}};
  return line;
}

/// Five samples with one thread, the last of them an outlier, and five with two.
inline std::vector<Json> sweep_lines() {
  std::vector<Json> lines;
  const std::vector<double> one{4.0, 4.1, 3.9, 4.0, 9.0};
  const std::vector<double> two{2.5, 2.4, 2.6, 2.5, 2.5};
  for (int repeat = 0; repeat < 5; ++repeat) {
    lines.push_back(sweep_line(1, repeat, one[static_cast<std::size_t>(repeat)]));
    lines.push_back(sweep_line(2, repeat, two[static_cast<std::size_t>(repeat)]));
  }
  return lines;
}

}  // namespace cbc3d::reports
