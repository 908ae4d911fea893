// The library's messages name parameters; Python's user knows keywords.
#pragma once

#include <string>

namespace cbc3d::python {

/// `text` with every option of the table under its keyword: "lattice_spacing_mm" and "lattice-spacing" become
/// "lattice_spacing".
std::string with_keywords(std::string text);

/// An option's name as a keyword: with _ for -.
std::string keyword_of(std::string name);

}  // namespace cbc3d::python
