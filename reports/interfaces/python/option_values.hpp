// The table of options for Python: keyword arguments, and rows for docstrings and stubs.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "mesher/pipeline/option_table.hpp"

namespace cbc3d::python {

/// Keyword arguments as settings. A value is a bool, an int, a float, a str or, for options of single labels,
/// a dict from labels to numbers; None leaves the preset's. Throws OptionError.
OptionSettings settings_of(const pybind11::dict& keywords);

/// One dict for each option: keyword, flag, group, kind, unit, range, choices, text and defaults by preset.
pybind11::list option_rows();

}  // namespace cbc3d::python
