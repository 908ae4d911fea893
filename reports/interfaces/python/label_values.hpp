// Label images from numpy arrays.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <memory>
#include <string>

#include "mesher/core/label_array.hpp"

namespace cbc3d::python {

/// An array's values as the library takes them, i fastest, and what keeps them alive.
struct LabelValues {
  LabelArray values;
  Index3 size{};                     ///< along i, j and k
  std::shared_ptr<const void> copy;  ///< null where the values are the array's own
};

/// The values of an array of three axes. `axes` says what the array's axes are: "kji" for array[k, j, i], as
/// SimpleITK has it, or "ijk" for array[i, j, k], as nibabel has it. The values are taken where they lie when
/// i is the fastest in memory: C order for "kji", Fortran order for "ijk". Else they are copied, labels from
/// 0 to 255 to one byte each. Throws InputError for other types than integers and booleans and for other
/// numbers of axes. The array must outlive the result.
LabelValues label_values(const pybind11::array& array, const std::string& axes);

/// A frame from sequences of 3, 3 and 9 numbers, as SimpleITK has them; the direction row by row, its columns
/// the axes i, j, k in physical space.
ImageFrame frame_of(const Index3& size, const std::array<double, 3>& spacing_mm,
                    const std::array<double, 3>& origin_mm, const std::array<double, 9>& direction);

}  // namespace cbc3d::python
