// Squared Euclidean distances on a grid, by lower envelopes of parabolas (Felzenszwalb and Huttenlocher
// 2012).
#pragma once

#include <cstdint>

#include "baselines/cleaver/cell_array.hpp"

namespace cbc3d::baselines::cleaver {

/// The largest squared distance that is told apart: beyond it all are equal.
inline constexpr std::uint16_t kFarSquared = 65535;

/// Replaces the values, 0 at sites and kFarSquared elsewhere, by squared distances to the nearest site, in
/// cells, at most kFarSquared.
void squared_distances(CellArray<std::uint16_t>& values);

}  // namespace cbc3d::baselines::cleaver
