#include "baselines/core/size_dial.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {
namespace {

using Parameters = std::map<std::string, std::string>;

std::optional<double> positive_number(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool good = error == std::errc() && end == text.data() + text.size() && number > 0;
  return good ? std::optional(number) : std::nullopt;
}

/// The value that a job has for a parameter, by itself or by default, where it is a number.
std::optional<double> value_of(const std::string& key, const ParameterSpecs& specs, const Parameters& given) {
  if (const auto found = given.find(key); found != given.end()) return positive_number(found->second);
  for (const ParameterSpec& spec : specs) {
    if (spec.key == key) return positive_number(spec.default_value);
  }
  return std::nullopt;
}

std::string five_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

}  // namespace

std::string dial_text(const SizeDial& dial, double value) {
  return dial.counts_elements ? std::to_string(std::llround(value)) : five_digits(value);
}

Parameters with_size(const SizeDial& dial, double value, const ParameterSpecs& specs,
                     const Parameters& given) {
  const auto own = value_of(dial.parameter, specs, given);
  Parameters turned = given;
  for (const auto& [key, text] : dial.fixed) turned[key] = text;
  turned[dial.parameter] = dial_text(dial, value);
  for (const auto& [key, usual_ratio] : dial.followers) {
    const auto other = value_of(key, specs, given);
    turned[key] = five_digits(value * (own && other ? *other / *own : usual_ratio));
  }
  return turned;
}

}  // namespace cbc3d::baselines
