#include "reports/interfaces/python/watched_work.hpp"

namespace cbc3d::python {

namespace py = pybind11;

bool Watcher::goes_on(std::string_view stage, double fraction) {
  if (PyErr_CheckSignals() != 0) {
    throw py::error_already_set();
  }
  if (callback_.is_none()) {
    return true;
  }
  const py::object answer = callback_(std::string(stage), fraction);
  return answer.is_none() || answer.cast<bool>();
}

bool Watcher::observe(std::string_view stage, double fraction) {
  const py::gil_scoped_acquire locked;
  try {
    return goes_on(stage, fraction);
  } catch (...) {  // the library knows nothing of Python's exceptions
    raised_ = std::current_exception();
    return false;
  }
}

}  // namespace cbc3d::python
