#include "mesher/formats/units.hpp"

#include <string>
#include <utility>

#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {

std::optional<double> millimetres_of(std::string_view unit) {
  static constexpr std::pair<std::string_view, double> kUnits[] = {
      {"mm", 1},           {"millimeter", 1},    {"millimetre", 1},
      {"um", 1e-3},        {"\xC2\xB5m", 1e-3},  {"\xCE\xBCm", 1e-3},
      {"\xB5m", 1e-3},     {"micrometer", 1e-3}, {"micrometre", 1e-3},
      {"micron", 1e-3},    {"nm", 1e-6},         {"nanometer", 1e-6},
      {"nanometre", 1e-6}, {"cm", 10},           {"centimeter", 10},
      {"centimetre", 10},  {"m", 1e3},           {"meter", 1e3},
      {"metre", 1e3},      {"in", 25.4},         {"inch", 25.4}};
  std::string word = lower_case(trimmed(unit));
  const auto find = [&]() -> std::optional<double> {
    for (const auto& [name, mm] : kUnits) {
      if (word == name) {
        return mm;
      }
    }
    return std::nullopt;
  };
  const auto found = find();
  if (!found && word.size() > 3 && word.ends_with('s')) {  // the plural
    word.pop_back();
    return find();
  }
  return found;
}

}  // namespace cbc3d::formats
