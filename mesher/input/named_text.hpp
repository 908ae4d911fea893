// Names of labels in what people read.
#pragma once

#include <string>

#include "mesher/core/label_names.hpp"

namespace cbc3d {

/// The text with "right lung (5)" in place of "label 5" wherever the label has a name; what stands in single
/// quotes, as names of files do, stays.
std::string with_names(const std::string& text, const LabelNames& names);

}  // namespace cbc3d
