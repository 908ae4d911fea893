#include "mesher/app/natural_order.hpp"

#include <algorithm>
#include <cctype>

namespace cbc3d {
namespace {

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// The run of digits at the beginning, which is taken from `text`.
std::string_view take_number(std::string_view& text) {
  const auto end = std::find_if_not(text.begin(), text.end(), is_digit);
  const std::string_view number = text.substr(0, static_cast<std::size_t>(end - text.begin()));
  text.remove_prefix(number.size());
  return number;
}

std::string_view without_zeros(std::string_view number) {
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

/// Below, at or above zero as the numbers are.
int compare_values(std::string_view a, std::string_view b) {
  const std::string_view x = without_zeros(a), y = without_zeros(b);
  return x.size() != y.size() ? (x.size() < y.size() ? -1 : 1) : x.compare(y);
}

}  // namespace

bool comes_before(std::string_view a, std::string_view b) {
  int zeros = 0;  // decides between names that are alike otherwise
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const std::string_view x = take_number(a), y = take_number(b);
      if (const int order = compare_values(x, y); order != 0) {
        return order < 0;
      }
      zeros =
          zeros != 0 ? zeros : static_cast<int>(x.size() > y.size()) - static_cast<int>(x.size() < y.size());
    } else if (a.front() != b.front()) {
      return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front());
    } else {
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  return a.empty() != b.empty() ? a.empty() : zeros < 0;
}

}  // namespace cbc3d
