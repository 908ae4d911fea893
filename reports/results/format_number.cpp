#include "reports/results/format_number.hpp"

#include <algorithm>
#include <cstdio>

namespace cbc3d::reports {

std::string format_number(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  std::string text = buffer;
  const std::size_t first_digit = text.find_first_of("0123456789");
  std::size_t at = std::min(text.find('.'), text.size());
  while (first_digit != std::string::npos && at > first_digit + 3) {
    at -= 3;
    text.insert(at, 1, ',');
  }
  return text;
}

}  // namespace cbc3d::reports
