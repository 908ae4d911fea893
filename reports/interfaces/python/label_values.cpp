#include "reports/interfaces/python/label_values.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/core/uninitialized_vector.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;

/// An array's memory by the image's axes, whatever the array's own order is.
struct Layout {
  const std::byte* data = nullptr;
  std::array<std::ptrdiff_t, 3> size{}, stride_bytes{};  ///< along i, j and k

  [[nodiscard]] bool is_i_fastest(std::ptrdiff_t value_bytes) const {
    std::ptrdiff_t expected = value_bytes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (size[axis] > 1 && stride_bytes[axis] != expected) {
        return false;
      }
      expected *= size[axis];
    }
    return reinterpret_cast<std::uintptr_t>(data) % static_cast<std::uintptr_t>(value_bytes) == 0;
  }
  [[nodiscard]] std::ptrdiff_t count() const { return size[0] * size[1] * size[2]; }
};

Layout layout_of(const py::array& array, const std::string& axes) {
  if (axes != "kji" && axes != "ijk") {
    throw InputError("axes " + axes + ": give kji, for array[k, j, i], or ijk, for array[i, j, k]", "axes");
  }
  if (array.ndim() != 3) {
    throw InputError(
        "the label array: it has " + std::to_string(array.ndim()) + " axes; give an array of three", "array");
  }
  Layout layout;
  layout.data = static_cast<const std::byte*>(array.data());
  for (int axis = 0; axis < 3; ++axis) {
    const int of_array = axes == "ijk" ? axis : 2 - axis;
    layout.size[static_cast<std::size_t>(axis)] = array.shape(of_array);
    layout.stride_bytes[static_cast<std::size_t>(axis)] = array.strides(of_array);
  }
  return layout;
}

/// Calls `visit(value, position)` for every voxel, position counting i fastest.
template <typename Value, typename Visit>
void for_each_in_rows(const Layout& layout, std::ptrdiff_t k, const Visit& visit) {
  std::ptrdiff_t position = k * layout.size[0] * layout.size[1];
  for (std::ptrdiff_t j = 0; j < layout.size[1]; ++j) {
    const std::byte* at = layout.data + k * layout.stride_bytes[2] + j * layout.stride_bytes[1];
    for (std::ptrdiff_t i = 0; i < layout.size[0]; ++i, at += layout.stride_bytes[0]) {
      Value value;
      std::copy_n(at, sizeof value, reinterpret_cast<std::byte*>(&value));
      visit(value, position++);
    }
  }
}

template <typename Value>
bool fits_a_byte(const Layout& layout) {
  bool fits = true;
#pragma omp parallel for schedule(static) reduction(&& : fits)
  for (std::ptrdiff_t k = 0; k < layout.size[2]; ++k) {
    for_each_in_rows<Value>(layout, k, [&fits](Value value, std::ptrdiff_t) {
      fits = fits && std::in_range<std::uint8_t>(value);
    });
  }
  return fits;
}

template <typename Value, typename Kept>
void copy_as(const Layout& layout, LabelValues& result) {
  auto kept = std::make_shared<UninitializedVector<Kept>>(static_cast<std::size_t>(layout.count()));
  Kept* const out = kept->data();
#pragma omp parallel for schedule(static)
  for (std::ptrdiff_t k = 0; k < layout.size[2]; ++k) {
    for_each_in_rows<Value>(
        layout, k, [out](Value value, std::ptrdiff_t position) { out[position] = static_cast<Kept>(value); });
  }
  result.values = std::span<const Kept>(*kept);
  result.copy = std::move(kept);
}

template <typename Value>
void take(const Layout& layout, LabelValues& result) {
  if (layout.is_i_fastest(sizeof(Value))) {
    result.values = std::span<const Value>(reinterpret_cast<const Value*>(layout.data),
                                           static_cast<std::size_t>(layout.count()));
  } else if (fits_a_byte<Value>(layout)) {
    copy_as<Value, std::uint8_t>(layout, result);
  } else {
    copy_as<Value, Value>(layout, result);
  }
}

/// By kind and size, for numpy has two types of eight bytes.
void take(char kind, py::ssize_t bytes, const Layout& layout, LabelValues& result) {
  const bool is_signed = kind == 'i';
  switch (bytes) {
    case 1:
      return is_signed ? take<std::int8_t>(layout, result) : take<std::uint8_t>(layout, result);
    case 2:
      return is_signed ? take<std::int16_t>(layout, result) : take<std::uint16_t>(layout, result);
    case 4:
      return is_signed ? take<std::int32_t>(layout, result) : take<std::uint32_t>(layout, result);
    default:
      return is_signed ? take<std::int64_t>(layout, result) : take<std::uint64_t>(layout, result);
  }
}

}  // namespace

LabelValues label_values(const py::array& array, const std::string& axes) {
  const char kind = array.dtype().kind();
  if (kind != 'i' && kind != 'u' && kind != 'b') {
    throw InputError("the label array: its type is " + std::string(py::str(array.dtype())) +
                         "; give integers, as array.astype(numpy.int32)",
                     "array");
  }
  const Layout layout = layout_of(array, axes);
  LabelValues result;
  std::transform(layout.size.begin(), layout.size.end(), result.size.begin(),
                 [](std::ptrdiff_t n) { return static_cast<int>(n); });
  take(kind, array.itemsize(), layout, result);
  return result;
}

ImageFrame frame_of(const Index3& size, const std::array<double, 3>& spacing_mm,
                    const std::array<double, 3>& origin_mm, const std::array<double, 9>& direction) {
  ImageFrame frame;
  frame.size = size;
  frame.spacing_mm = {spacing_mm[0], spacing_mm[1], spacing_mm[2]};
  frame.origin_mm = {origin_mm[0], origin_mm[1], origin_mm[2]};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      frame.direction(row, column) =
          direction[3 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)];
    }
  }
  return frame;
}

}  // namespace cbc3d::python
