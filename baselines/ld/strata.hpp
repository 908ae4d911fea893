// Which stratum of the interfaces a lattice point is on, and in which directions it may leave its place
// without changing them, both from the eight cells around it.
//
// The interfaces of an image are a complex of surfaces: inside a material is the stratum of dimension three,
// where two materials meet a sheet, where sheets meet a line, and everything else a point. Around a point of
// a sheet the interfaces meet a small sphere in one closed curve; around one of a line in two poles and at
// least three arcs from the one to the other.
#pragma once

#include <array>
#include <cstdint>

#include "mesher/core/label_voxels.hpp"

namespace cbc3d::baselines::ld {

enum class Stratum : std::uint8_t { volume, sheet, line, point };

/// The materials of the eight cells around a corner: number bit 0 is set on the far side along x, 1 y, 2 z.
using CellsAround = std::array<MaterialId, 8>;

/// The stratum of a corner. Non-manifold edges count as lines, for a merge along them keeps them;
/// non-manifold vertices as points.
Stratum stratum_of(const CellsAround& around);

/// The axes (bit 0 for x, ...) of the normals of all faces between different materials at a corner. A vertex
/// that moves in no such direction stays on every face that it is on.
std::uint8_t normal_axes_of(const CellsAround& around);

}  // namespace cbc3d::baselines::ld
