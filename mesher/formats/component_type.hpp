// From the component of an image to its type in C++: the one place that lists both.
#pragma once

#include <cstdint>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// Calls f with a null pointer to the component's type and returns what f returns.
template <typename F>
decltype(auto) with_type(Component component, const F& f) {
  switch (component) {
    case Component::uint8:
      return f(static_cast<const std::uint8_t*>(nullptr));
    case Component::int8:
      return f(static_cast<const std::int8_t*>(nullptr));
    case Component::uint16:
      return f(static_cast<const std::uint16_t*>(nullptr));
    case Component::int16:
      return f(static_cast<const std::int16_t*>(nullptr));
    case Component::uint32:
      return f(static_cast<const std::uint32_t*>(nullptr));
    case Component::int32:
      return f(static_cast<const std::int32_t*>(nullptr));
    case Component::uint64:
      return f(static_cast<const std::uint64_t*>(nullptr));
    case Component::int64:
      return f(static_cast<const std::int64_t*>(nullptr));
    case Component::float32:
      return f(static_cast<const float*>(nullptr));
    default:
      return f(static_cast<const double*>(nullptr));
  }
}

}  // namespace cbc3d::formats
