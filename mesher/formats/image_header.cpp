#include "mesher/formats/image_header.hpp"

#include <cmath>
#include <limits>

#include "mesher/formats/component_type.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr double kLeastSpacing = 1e-6, kMostSpacing = 1e6, kMostOrigin = 1e9;
constexpr std::size_t kMostBytes = std::size_t{1} << 62U;

std::string triple_text(const Triple& v) {
  return number_text(v[0]) + " " + number_text(v[1]) + " " + number_text(v[2]);
}

}  // namespace

std::size_t bytes_of(Component component) {
  return with_type(component, [](const auto* type) { return sizeof(*type); });
}

std::size_t voxel_bytes(const ImageHeader& header) {
  std::size_t bytes = bytes_of(header.component);
  for (const std::size_t size : {header.size[0], header.size[1], header.size[2], header.volumes}) {
    if (size == 0 || bytes > kMostBytes / size) {
      throw FormatError("its sizes " + std::to_string(header.size[0]) + " " + std::to_string(header.size[1]) +
                        " " + std::to_string(header.size[2]) +
                        (header.volumes > 1 ? " " + std::to_string(header.volumes) : std::string()) +
                        " are more voxels than can be counted; repair its header");
    }
    bytes *= size;
  }
  return bytes;
}

void require_sound(const ImageHeader& header) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (header.size[axis] < 1 || header.size[axis] > std::numeric_limits<std::int32_t>::max()) {
      throw FormatError("its size along axis " + std::to_string(axis) + " is " +
                        std::to_string(header.size[axis]) + "; repair its header");
    }
    if (!(header.spacing_mm[axis] >= kLeastSpacing && header.spacing_mm[axis] <= kMostSpacing)) {
      throw FormatError("its spacing " + triple_text(header.spacing_mm) +
                        " mm is not between 1e-6 and 1e6 mm; repair its header");
    }
    if (!(std::fabs(header.origin_mm[axis]) <= kMostOrigin)) {
      throw FormatError("its origin " + triple_text(header.origin_mm) +
                        " mm is not finite or beyond 1e9 mm; repair its header");
    }
    for (const double entry : header.axes[axis]) {
      if (!std::isfinite(entry)) {
        throw FormatError("its direction matrix has an entry that is no finite number; repair its header");
      }
    }
  }
  if (!std::isfinite(header.slope) || !std::isfinite(header.intercept)) {
    throw FormatError("its values are to be scaled by figures that are not finite; repair its header");
  }
  voxel_bytes(header);
}

void set_steps(ImageHeader& header, const std::array<Triple, 3>& steps, const std::string& what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Triple& v = steps[axis];
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0) || !std::isfinite(length)) {
      throw FormatError("its " + what + " has the vector " + triple_text(v) + " for axis " +
                        std::to_string(axis) + ", which is no direction; repair its header");
    }
    header.spacing_mm[axis] = length;
    for (std::size_t row = 0; row < 3; ++row) {
      header.axes[axis][row] = v[row] * (1.0 / length);
    }
  }
}

}  // namespace cbc3d::formats
