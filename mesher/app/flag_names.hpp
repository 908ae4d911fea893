// The library's messages name parameters; the command line's user knows flags.
#pragma once

#include <string>

namespace cbc3d {

/// `text` with every parameter that the library's messages name replaced by its flag: "lattice_spacing_mm" by
/// "--lattice-spacing". Names inside longer words, paths or quotes stay.
std::string with_flags(std::string text);

}  // namespace cbc3d
