// The class cbc3d.Mesh.
#pragma once

#include <pybind11/pybind11.h>

namespace cbc3d::python {

/// Adds the class to the module. Its arrays are views of the mesh's own memory, which they keep alive.
void add_mesh_class(pybind11::module_& module);

}  // namespace cbc3d::python
