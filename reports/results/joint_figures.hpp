// The figures of a job's repeats as one.
#pragma once

#include <vector>

#include "metrics/catalog.hpp"

namespace cbc3d::reports {

/// The repeats' figures joined as the catalog says, by the median or the least. What is derived comes from
/// the joint figures: the time ratio is the least disturbed of the job's CPU times over the least disturbed
/// of the reference's.
metrics::Figures joint_figures(const std::vector<const metrics::Figures*>& repeats);

}  // namespace cbc3d::reports
