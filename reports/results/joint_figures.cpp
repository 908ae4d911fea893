#include "reports/results/joint_figures.hpp"

#include <algorithm>

#include "reports/statistics/robust.hpp"

namespace cbc3d::reports {

metrics::Figures joint_figures(const std::vector<const metrics::Figures*>& repeats) {
  metrics::Figures joint;
  for (const metrics::MetricId id : metrics::all_metrics()) {
    std::vector<double> values;
    for (const metrics::Figures* figures : repeats) {
      if (const auto& figure = (*figures)[id]) {
        values.push_back(*figure);
      }
    }
    if (!values.empty()) {
      joint[id] = metrics::metric(id).repeats == metrics::Repeats::least
                      ? *std::min_element(values.begin(), values.end())
                      : median(values);
    }
  }
  joint.derive();
  return joint;
}

}  // namespace cbc3d::reports
