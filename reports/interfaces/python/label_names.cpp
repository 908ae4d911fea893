#include "reports/interfaces/python/label_names.hpp"

#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/input/label_table.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;

constexpr const char* kNames = "_names";
constexpr const char* kColours = "_colours";

/// The dict that an object keeps under a key, made where it is not there.
py::dict kept(const py::object& self, const char* key) {
  py::dict all = self.attr("__dict__");
  if (!all.contains(key)) all[key] = py::dict();
  return all[key];
}

void require(bool holds, const std::string& name, const char* remedy) {
  if (!holds) throw InputError(name + ": give " + remedy, name);
}

Label label_of(const py::handle& key, const std::string& name) {
  require(PyLong_Check(key.ptr()) != 0 || PyIndex_Check(key.ptr()) != 0, name,
          "a dict whose keys are labels");
  try {
    return key.cast<Label>();
  } catch (const py::cast_error&) {
    throw InputError(name + ": the label " + std::string(py::str(key)) + " is no integer of 32 bits", name);
  }
}

void add_names(const py::dict& given, LabelNames& names) {
  for (const auto& [label, name] : given) {
    require(py::isinstance<py::str>(name), "names", "a dict from labels to texts, {5: \"right lung\"}");
    names.set({.label = label_of(label, "names"), .name = name.cast<std::string>(), .colour = {}});
  }
}

void add_colours(const py::dict& given, LabelNames& names) {
  for (const auto& [key, colour] : given) {
    const Label label = label_of(key, "colours");
    const NamedLabel* const known = names.find(label);
    try {
      names.set({.label = label,
                 .name = known == nullptr ? std::string() : known->name,
                 .colour = colour.cast<std::array<std::uint8_t, 3>>()});
    } catch (const py::cast_error&) {
      throw InputError("colours: give three whole numbers from 0 to 255 for each label", "colours");
    }
  }
}

/// A property whose value is a dict that may be changed in place.
void add_dict(py::object& type, const char* name, const char* key) {
  const py::cpp_function get([key](const py::object& self) { return kept(self, key); });
  const py::cpp_function set(
      [key](const py::object& self, const py::dict& value) { py::dict(self.attr("__dict__"))[key] = value; });
  type.attr(name) = py::module_::import("builtins").attr("property")(get, set);
}

}  // namespace

LabelNames label_names(const py::object& given) {
  if (given.is_none()) return {};
  if (py::isinstance<py::dict>(given)) {
    LabelNames names;
    add_names(given, names);
    return names;
  }
  require(py::isinstance<py::str>(given) || py::hasattr(given, "__fspath__"), "names",
          "a dict from labels to texts, or the path of a table");
  return read_label_table(py::module_::import("os").attr("fspath")(given).cast<std::string>());
}

LabelNames names_of(const py::object& mesh) {
  LabelNames names;
  add_names(kept(mesh, kNames), names);
  add_colours(kept(mesh, kColours), names);
  return names;
}

void set_names(const py::object& mesh, const LabelNames& names) {
  py::dict texts, colours;
  for (const NamedLabel& named : names.entries()) {
    const py::int_ label(named.label);
    if (!named.name.empty()) texts[label] = named.name;
    if (named.colour) colours[label] = py::tuple(py::cast(*named.colour));
  }
  mesh.attr("names") = texts;
  mesh.attr("colours") = colours;
}

void add_names(py::object type) {
  add_dict(type, "names", kNames);
  add_dict(type, "colours", kColours);
}

}  // namespace cbc3d::python
