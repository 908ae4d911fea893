// The parameter by which the size of a mesher's elements, and so their number, is set.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cbc3d::baselines {

struct ParameterSpec;

/// A mesher's size dial. The number of elements is about proportional to a power of its value; a search
/// measures what the power really is.
struct SizeDial {
  std::string parameter;   ///< key of the parameter that is turned; its values are > 0
  double exponent = -2.5;  ///< of the power: -3 for a length that all elements have, -2 for one of surfaces
  double first = 1;        ///< value of the first try
  double lowest = 1e-3;    ///< least value that is tried
  double highest = 1e3;    ///< largest value that is tried
  bool counts_elements = false;  ///< the value is a number of elements: the first try is what is wanted
  /// Parameters that are turned along, with their ratio to the dial's parameter. Where a job gives both, or
  /// the mesher has a number as the default of one that it does not give, their ratio is that of the job.
  std::map<std::string, double> followers = {};
  /// Parameters that have these values whenever the dial is turned, so that it decides.
  std::map<std::string, std::string> fixed = {};
};

/// A dial's value as the text of a parameter: five digits, or a whole number where it counts elements.
std::string dial_text(const SizeDial& dial, double value);

/// The parameters of a job with the dial at `value`: `given` with the dial's parameter and its followers
/// replaced. `specs` has the mesher's defaults.
std::map<std::string, std::string> with_size(const SizeDial& dial, double value,
                                             const std::vector<ParameterSpec>& specs,
                                             const std::map<std::string, std::string>& given);

}  // namespace cbc3d::baselines
