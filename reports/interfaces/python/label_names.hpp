// Names and colours of labels between Python and the library.
#pragma once

#include <pybind11/pybind11.h>

#include "mesher/core/label_names.hpp"

namespace cbc3d::python {

/// A table of names from a mapping {label: name}, or from a table's file. Throws InputError.
LabelNames label_names(const pybind11::object& given);

/// What a mesh's attributes `names` and `colours` hold, dicts by label.
LabelNames names_of(const pybind11::object& mesh);
void set_names(const pybind11::object& mesh, const LabelNames& names);

/// Adds `names` and `colours` to a class of meshes whose objects have a __dict__.
void add_names(pybind11::object type);

}  // namespace cbc3d::python
