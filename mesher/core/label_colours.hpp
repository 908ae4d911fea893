// Colours of labels in pictures, where none is given.
#pragma once

#include <array>
#include <cstddef>

namespace cbc3d {

/// Red, green and blue in [0, 1] of the label in the given place, from 0, of a list. Ten are chosen so that
/// they can be told apart; further ones stand around the circle of colours by the golden angle.
std::array<double, 3> label_colour(std::size_t place);

}  // namespace cbc3d
