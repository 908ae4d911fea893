// The extension `cbc3d._core`.
#include <pybind11/pybind11.h>

#include <exception>
#include <string>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/mesh_formats/output_texts.hpp"
#include "mesher/pipeline/presets.hpp"
#include "reports/interfaces/python/input_values.hpp"
#include "reports/interfaces/python/keyword_names.hpp"
#include "reports/interfaces/python/mesh_class.hpp"
#include "reports/interfaces/python/option_values.hpp"
#include "reports/interfaces/python/watched_work.hpp"
#include "reports/interfaces/python/work.hpp"

#include <pybind11/stl.h>

namespace cbc3d::python {
namespace {

namespace py = pybind11;

/// The module's own exceptions, which live as long as the interpreter.
struct Exceptions {
  PyObject* input = nullptr;
  PyObject* job = nullptr;
  PyObject* cancelled = nullptr;
};

Exceptions& exceptions() {
  static Exceptions all;
  return all;
}

PyObject* add_exception(py::module_& module, const char* name, PyObject* bases, const char* text) {
  PyObject* type = PyErr_NewExceptionWithDoc((std::string("cbc3d.") + name).c_str(), text, bases, nullptr);
  module.attr(name) = py::reinterpret_borrow<py::object>(type);
  return type;
}

void raise_input_error(const InputError& error) {
  const py::object raised =
      py::reinterpret_borrow<py::object>(exceptions().input)(with_keywords(error.what()));
  raised.attr("parameter") = with_keywords(error.parameter());
  PyErr_SetObject(exceptions().input, raised.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const InputError& error) {
    raise_input_error(error);
  } catch (const JobError& error) {
    PyErr_SetString(exceptions().job, with_keywords(error.what()).c_str());
  } catch (const Cancelled& cancelled) {
    PyErr_SetString(exceptions().cancelled, cancelled.what());
  }
}

void add_exceptions(py::module_& module) {
  PyObject* error = add_exception(module, "Error", PyExc_RuntimeError, "What all errors of cbc3d are.");
  const py::tuple input_bases = py::make_tuple(py::handle(error), py::handle(PyExc_ValueError));
  exceptions().input = add_exception(
      module, "InputError", input_bases.ptr(),
      "Arguments or input that cannot be taken: the message names the value and the remedy, `parameter` the "
      "keyword at fault, or is empty.");
  exceptions().job =
      add_exception(module, "JobError", error, "Work that failed although its input was good.");
  exceptions().cancelled =
      add_exception(module, "Cancelled", error, "Work that ended because its callback returned False.");
  py::register_exception_translator(&translate);
}

}  // namespace
}  // namespace cbc3d::python

PYBIND11_MODULE(_core, module) {
  using namespace cbc3d::python;
  add_exceptions(module);
  add_mesh_class(module);
  add_work(module);
  module.def("option_rows", &option_rows);
  module.def("input_rows", &input_rows);
  module.def("preset_names", &cbc3d::preset_names);
  module.def("mesh_format_names", &cbc3d::mesh_format_names);
  module.attr("order_text") = cbc3d::kOrderText;
  module.attr("split_interfaces_text") = cbc3d::kSplitInterfacesText;
  module.def("works_left_behind", &works_left_behind);
  // The interpreter ends after the threads that use its process.
  pybind11::module_::import("atexit").attr("register")(pybind11::cpp_function(&wait_for_works_left_behind));
  module.attr("__version__") = CBC3D_VERSION;
}
