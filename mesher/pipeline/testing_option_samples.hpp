// A good value for every option.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "mesher/pipeline/option_table.hpp"

namespace cbc3d::testing {

/// A value of the range. With those tried first a small image can be meshed; 5 mm is half of the coarsest
/// lattice spacing of voxels of 1 mm, to which finest-spacing is rounded.
inline double number_within(const NumberRange& range, double other_than) {
  for (const double number : {5.0, 0.25, 0.75}) {
    if (range.contains(number) && number != other_than) return number;
  }
  return std::isinf(range.highest) ? 2 * range.lowest + 1 : (range.lowest + range.highest) / 2;
}

inline std::int64_t count_within(const NumberRange& range, std::int64_t other_than) {
  constexpr std::int64_t kMany = 12000, kFew = 6;
  return range.contains(kMany) && kMany != other_than ? kMany : kFew != other_than ? kFew : kFew + 1;
}

/// A text that the option takes and that stands for another value than the one in `preset`.
inline std::string option_sample(const OptionRow& row, const MeshImageOptions& preset) {
  const OptionValue value = row.get(preset);
  switch (row.kind) {
    case OptionKind::number:
      return value_text(number_within(row.range, std::get<double>(value)));
    case OptionKind::count:
      return value_text(count_within(row.range, std::get<std::int64_t>(value)));
    case OptionKind::on_off:
      return value_text(!std::get<bool>(value));
    case OptionKind::choice:
      return row.choices[row.choices[0] == std::get<std::string>(value) ? 1 : 0];
    case OptionKind::label_numbers:
      break;
  }
  return value_text(LabelNumbers{{2, number_within(row.range, NAN)}});
}

}  // namespace cbc3d::testing
