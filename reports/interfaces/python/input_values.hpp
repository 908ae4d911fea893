// The choices about an array, from the table of those about images: keywords, and rows for docstrings and
// stubs.
#pragma once

#include <pybind11/pybind11.h>

#include "mesher/input/image_input.hpp"

namespace cbc3d::python {

/// Takes the keywords that are choices out of `keywords` and makes them; None is a choice not made. The
/// volume of an array of four axes is taken in Python. Throws InputError.
ImageInput take_choices(pybind11::dict& keywords);

/// One dict for each choice: keyword, flag, group, kind, range, text and the default.
pybind11::list input_rows();

/// Names, choices and the check for grey arrays, applied to an array's image. Throws InputError.
void apply_choices(LabelImage& image, ImageInput& input);

}  // namespace cbc3d::python
