#include "reports/interfaces/python/option_values.hpp"

#include <pybind11/stl.h>

#include "mesher/pipeline/presets.hpp"
#include "reports/interfaces/python/keyword_names.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;

LabelNumbers label_numbers_of(const py::dict& numbers) {
  LabelNumbers by_label;
  for (const auto& [label, number] : numbers) {
    by_label[label.cast<Label>()] = number.cast<double>();
  }
  return by_label;
}

/// Numbers of numpy are numbers too: whatever has __index__ or __float__.
OptionValue value_of(const OptionRow& row, const py::handle& value) {
  try {
    if (py::isinstance<py::str>(value)) return value.cast<std::string>();
    if (py::isinstance<py::dict>(value)) return label_numbers_of(value.cast<py::dict>());
    switch (row.kind) {
      case OptionKind::on_off:
        return value.cast<bool>();
      case OptionKind::count:
        return value.cast<std::int64_t>();
      default:
        return value.cast<double>();
    }
  } catch (const py::cast_error&) {
    throw OptionError(row.name + " " + std::string(py::repr(value)) + ": give " +
                      (row.kind == OptionKind::label_numbers ? "a dict from labels to numbers "
                       : row.kind == OptionKind::count       ? "a whole number "
                       : row.kind == OptionKind::number      ? "a number "
                                                             : "") +
                      range_text(row));
  }
}

const char* kind_text(OptionKind kind) {
  switch (kind) {
    case OptionKind::number:
      return "float";
    case OptionKind::count:
      return "int";
    case OptionKind::on_off:
      return "bool";
    case OptionKind::choice:
      return "choice";
    case OptionKind::label_numbers:
      return "label_numbers";
  }
  return "";
}

py::dict defaults_of(const OptionRow& row) {
  const ImageFrame frame;  // of voxels of 1 mm
  py::dict defaults;
  for (const std::string& preset : preset_names()) {
    const MeshImageOptions options = preset_options(preset, frame);
    if (has_option(options, row)) {
      defaults[preset.c_str()] = default_text(row, options, frame.voxel_diagonal_mm());
    }
  }
  return defaults;
}

}  // namespace

OptionSettings settings_of(const py::dict& keywords) {
  OptionSettings settings;
  for (const auto& [keyword, value] : keywords) {
    const OptionRow& row = find_option(keyword.cast<std::string>());
    if (!value.is_none()) {
      settings.emplace_back(row.name, checked_value(row, value_of(row, value)));
    }
  }
  return settings;
}

py::list option_rows() {
  using py::literals::operator""_a;
  py::list rows;
  for (const OptionRow& row : option_table()) {
    rows.append(py::dict("keyword"_a = keyword_of(row.name), "flag"_a = "--" + row.name,
                         "group"_a = heading(row.group), "kind"_a = kind_text(row.kind), "unit"_a = row.unit,
                         "range"_a = range_text(row), "choices"_a = row.choices, "text"_a = row.text,
                         "defaults"_a = defaults_of(row)));
  }
  return rows;
}

}  // namespace cbc3d::python
