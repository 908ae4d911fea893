#include "mesher/app/label_values.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::map<Label, double> parse_label_values(const std::string& option, const std::vector<std::string>& texts,
                                           const LabelImage& image, const ValueRule& rule) {
  std::map<Label, double> values;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    Label label = 0;
    double value = 0;
    if (equals == std::string::npos || !parse_number(std::string_view(text).substr(0, equals), label) ||
        !parse_number(std::string_view(text).substr(equals + 1), value) || !rule.holds(value)) {
      throw InputError(option + " " + text + ": give LABEL=" + rule.text);
    }
    if (std::find(image.labels.begin() + 1, image.labels.end(), label) == image.labels.end()) {
      throw InputError(option + " " + text + ": the image has no label " + std::to_string(label));
    }
    values[label] = value;
  }
  return values;
}

}  // namespace cbc3d
