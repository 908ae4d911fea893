#include "reports/interfaces/python/input_values.hpp"

#include <optional>
#include <string>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/preprocess/grey_check.hpp"
#include "reports/interfaces/python/keyword_names.hpp"
#include "reports/interfaces/python/label_names.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

constexpr const char* kArray = "the label array";

/// Nothing where the value is no whole number. Arrays claim to be one, and are if they have no axis.
std::optional<std::string> whole_number_text(const py::handle& value) {
  if (PyIndex_Check(value.ptr()) == 0) return std::nullopt;
  const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!number) {
    PyErr_Clear();
    return std::nullopt;
  }
  return std::string(py::str(number));
}

/// The value of a keyword as a text of the command line: a sequence with commas between its members.
std::string text_of(const py::handle& value) {
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>() ? "true" : "false";
  if (const auto number = whole_number_text(value)) return *number;
  if (!py::hasattr(value, "__iter__")) {
    const std::string text = py::str(value);
    return text == "True" ? "true" : text == "False" ? "false" : text;  // numpy's booleans
  }
  std::string text;
  for (const py::handle member : value) text += (text.empty() ? "" : ",") + text_of(member);
  return text;
}

const char* kind_text(const InputField& field) {
  constexpr const char* kKinds[] = {"bool", "int", "names", "labels"};  // in the order of InputField
  return kKinds[field.index()];
}

}  // namespace

ImageInput take_choices(py::dict& keywords) {
  ImageInput input;
  for (const InputOption* const option : input_options_of(InputSource::array, InputScope::image)) {
    const py::str keyword(keyword_of(option->name));
    if (!keywords.contains(keyword)) continue;
    const py::object value = keywords[keyword];
    keywords.attr("pop")(keyword);
    if (value.is_none()) continue;
    if (std::holds_alternative<std::string*>(option->field(input))) {
      input.names = label_names(value);
    } else {
      set_input_option(*option, text_of(value), input);
    }
  }
  return input;
}

py::list input_rows() {
  ImageInput input;
  py::list rows;
  for (const InputOption* const option : input_options_of(InputSource::array, InputScope::image)) {
    rows.append(py::dict("keyword"_a = keyword_of(option->name), "flag"_a = "--" + option->name,
                         "group"_a = input_heading(), "kind"_a = kind_text(option->field(input)),
                         "text"_a = option->text,
                         "default"_a = option->symbol.empty() ? "False" : option->default_text));
  }
  return rows;
}

void apply_choices(LabelImage& image, ImageInput& input) {
  choose_labels(image, input.names, input.choice, kArray, input.warnings);
  input.names = input.names.of({image.labels.begin() + 1, image.labels.end()});
  const std::string reason = input.many_labels ? "" : why_grey(image);
  if (!reason.empty()) {
    throw InputError(std::string(kArray) + ": " + reason + "; segment it first, or many_labels=True takes it",
                     "array");
  }
}

}  // namespace cbc3d::python
