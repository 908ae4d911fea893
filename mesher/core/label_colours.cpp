#include "mesher/core/label_colours.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {
namespace {

using Colour = std::array<double, 3>;

constexpr std::array<Colour, 10> kPalette{{{.85, .42, .36},
                                           {.42, .62, .80},
                                           {.95, .80, .42},
                                           {.47, .71, .46},
                                           {.66, .52, .75},
                                           {.93, .60, .33},
                                           {.40, .73, .71},
                                           {.88, .60, .73},
                                           {.68, .58, .44},
                                           {.73, .75, .78}}};

/// From hue, saturation and value, all in [0, 1].
Colour from_hsv(double hue, double saturation, double value) {
  Colour colour{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double turn = std::fmod(6 * hue + 5 - 2 * static_cast<double>(channel), 6.0);
    const double part = std::clamp(std::min(turn, 4 - turn), 0.0, 1.0);
    colour[channel] = value * (1 - saturation * part);
  }
  return colour;
}

}  // namespace

Colour label_colour(std::size_t place) {
  constexpr double kGolden = 0.618034, kSaturation = 0.45, kValue = 0.85;
  return place < kPalette.size()
             ? kPalette[place]
             : from_hsv(std::fmod(kGolden * static_cast<double>(place + 1), 1.0), kSaturation, kValue);
}

}  // namespace cbc3d
