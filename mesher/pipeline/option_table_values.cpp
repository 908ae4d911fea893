// Values of options: parsed, checked, written.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "mesher/core/one_line.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d {
namespace {

/// The whole text as a number; none otherwise.
template <typename Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::string number_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", number);
  return text;
}

std::string interval_text(const NumberRange& range) {
  if (std::isinf(range.highest)) {
    return (range.excludes_lowest ? "above " : "at least ") + number_text(range.lowest);
  }
  return (range.excludes_lowest ? "in (" : "in [") + number_text(range.lowest) + ", " +
         number_text(range.highest) + (range.excludes_highest ? ")" : "]");
}

std::string joined(const std::vector<std::string>& names, const std::string& last_separator) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? last_separator : ", ") + names[i];
  }
  return text;
}

/// What a user should give instead.
std::string remedy(const OptionRow& row) {
  switch (row.kind) {
    case OptionKind::number:
      return "give a number " + range_text(row);
    case OptionKind::count:
      return "give a whole number " + range_text(row);
    case OptionKind::label_numbers:
      return "give " + row.symbol + " with a number " + range_text(row) + ", as 2=0.4";
    default:
      return "give " + range_text(row);
  }
}

[[noreturn]] void refuse(const OptionRow& row, const OptionValue& value) {
  throw OptionError(row.name + " " + shortened(value_text(value)) + ": " + remedy(row));
}

/// None where the value is no number.
std::optional<double> as_number(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return parsed<double>(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

std::optional<std::int64_t> as_count(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return parsed<std::int64_t>(*text);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole;
  return std::nullopt;
}

std::optional<bool> as_switch(const OptionValue& value) {
  if (const auto* on = std::get_if<bool>(&value)) return *on;
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr || (*text != "true" && *text != "false")) return std::nullopt;
  return *text == "true";
}

/// "2=0.9,3=0.8"; none where a part is no LABEL=NUMBER.
std::optional<LabelNumbers> parsed_label_numbers(std::string_view text) {
  LabelNumbers numbers;
  while (true) {
    const std::string_view part = text.substr(0, text.find(','));
    const std::size_t equals = part.find('=');
    if (equals == std::string_view::npos) return std::nullopt;
    const auto label = parsed<Label>(part.substr(0, equals));
    const auto number = parsed<double>(part.substr(equals + 1));
    if (!label || !number) return std::nullopt;
    numbers[*label] = *number;
    if (part.size() == text.size()) return numbers;
    text.remove_prefix(part.size() + 1);
  }
}

std::optional<LabelNumbers> as_label_numbers(const OptionValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return parsed_label_numbers(*text);
  const auto* numbers = std::get_if<LabelNumbers>(&value);
  return numbers != nullptr ? std::optional(*numbers) : std::nullopt;
}

bool is_choice(const OptionRow& row, const OptionValue& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && std::find(row.choices.begin(), row.choices.end(), *text) != row.choices.end();
}

bool all_in(const NumberRange& range, const LabelNumbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [&](const auto& n) { return range.contains(n.second); });
}

OptionValue typed(const OptionRow& row, const OptionValue& value) {
  switch (row.kind) {
    case OptionKind::number:
      if (const auto number = as_number(value); number && row.range.contains(*number)) return *number;
      break;
    case OptionKind::count:
      if (const auto count = as_count(value); count && row.range.contains(static_cast<double>(*count)))
        return *count;
      break;
    case OptionKind::on_off:
      if (const auto on = as_switch(value)) return *on;
      break;
    case OptionKind::choice:
      if (is_choice(row, value)) return value;
      break;
    case OptionKind::label_numbers:
      if (auto numbers = as_label_numbers(value); numbers && all_in(row.range, *numbers)) return *numbers;
      break;
  }
  refuse(row, value);
}

struct ValueText {
  std::string operator()(bool on) const { return on ? "true" : "false"; }
  std::string operator()(std::int64_t count) const { return std::to_string(count); }
  std::string operator()(double number) const { return number_text(number); }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(const LabelNumbers& numbers) const {
    std::string text;
    for (const auto& [label, number] : numbers) {
      text += (text.empty() ? "" : ",") + std::to_string(label) + "=" + number_text(number);
    }
    return text;
  }
};

}  // namespace

bool NumberRange::contains(double value) const {
  return std::isfinite(value) && (excludes_lowest ? value > lowest : value >= lowest) &&
         (excludes_highest ? value < highest : value <= highest);
}

const OptionRow& find_option(std::string_view name) {
  std::string wanted(name);
  std::replace(wanted.begin(), wanted.end(), '_', '-');
  std::vector<std::string> known;
  for (const OptionRow& row : option_table()) {
    if (row.name == wanted) return row;
    known.push_back(row.name);
  }
  throw OptionError(shortened(wanted) + ": no such option; there are " + joined(known, " and "));
}

OptionValue checked_value(const OptionRow& row, const OptionValue& value) {
  return typed(row, value);
}

void set_option(MeshImageOptions& options, std::string_view name, const OptionValue& value) {
  const OptionRow& row = find_option(name);
  row.set(options, checked_value(row, value));
}

void apply_settings(const OptionSettings& settings, MeshImageOptions& options) {
  for (const bool of_labels : {false, true}) {
    for (const auto& [name, value] : settings) {
      if ((find_option(name).kind == OptionKind::label_numbers) == of_labels)
        set_option(options, name, value);
    }
  }
}

void require_known_labels(const MeshImageOptions& options, const LabelImage& image) {
  for (const OptionRow& row : option_table()) {
    if (row.kind != OptionKind::label_numbers) continue;
    const OptionValue value = row.get(options);
    for (const auto& [label, number] : std::get<LabelNumbers>(value)) {
      if (std::find(image.labels.begin() + 1, image.labels.end(), label) == image.labels.end()) {
        throw OptionError(row.name + " " + value_text(LabelNumbers{{label, number}}) +
                          ": the image has no label " + std::to_string(label));
      }
    }
  }
}

std::string heading(OptionGroup group) {
  switch (group) {
    case OptionGroup::cleaning:
      return "Image pre-processing";
    case OptionGroup::lattice:
      return "Lattice and its refinement";
    case OptionGroup::mixed:
      return "Mixed elements";
    case OptionGroup::improvement:
      return "Improvement";
    case OptionGroup::deformation:
      return "Deformation";
  }
  return "";
}

std::string range_text(const OptionRow& row) {
  switch (row.kind) {
    case OptionKind::on_off:
      return "true or false";
    case OptionKind::choice:
      return joined(row.choices, " or ");
    default:
      return interval_text(row.range);
  }
}

std::string report_key(const OptionRow& row) {
  std::string key = row.key.empty() ? row.name : row.key;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

bool has_option(const MeshImageOptions& preset, const OptionRow& row) {
  return row.group != OptionGroup::improvement || preset.improve.enabled;
}

std::string value_text(const OptionValue& value) {
  return std::visit(ValueText{}, value);
}

bool is_unset(const OptionRow& row, const MeshImageOptions& options) {
  const OptionValue value = row.get(options);
  if (const auto* numbers = std::get_if<LabelNumbers>(&value)) return numbers->empty();
  const auto* number = std::get_if<double>(&value);
  return number != nullptr && !row.range.contains(*number);
}

std::string default_text(const OptionRow& row, const MeshImageOptions& options, double voxel_diagonal_mm) {
  if (is_unset(row, options)) return row.unset_text;
  const OptionValue value = row.get(options);
  const auto* number = std::get_if<double>(&value);
  if (row.scales_with_voxels && *number != 0)
    return number_text(*number / voxel_diagonal_mm) + " voxel diagonals";
  return value_text(value);
}

}  // namespace cbc3d
