// Meshing, improvement and evaluation for Python.
#pragma once

#include <pybind11/pybind11.h>

namespace cbc3d::python {

/// Adds mesh_array, improve_mesh and evaluate_mesh, which the package's Python files wrap.
void add_work(pybind11::module_& module);

}  // namespace cbc3d::python
