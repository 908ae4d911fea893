// Options of the form LABEL=VALUE.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// What a value must be, for the check and for the message.
struct ValueRule {
  std::function<bool(double)> holds;
  std::string text;  ///< "F in (0, 1], for example 2=0.9"
};

/// Parses the values of a repeatable option. Throws InputError naming the option, the text and the remedy
/// when one is malformed, breaks the rule, or names a label that the image has not.
std::map<Label, double> parse_label_values(const std::string& option, const std::vector<std::string>& texts,
                                           const LabelImage& image, const ValueRule& rule);

}  // namespace cbc3d
