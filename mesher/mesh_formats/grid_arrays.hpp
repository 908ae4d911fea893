// Cells of a foreign mesh as plain arrays, and what they must be before they are a mesh.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d {

/// An unstructured grid as VTK has it: cell c has the nodes connectivity[offsets[c] ... offsets[c + 1]).
struct GridArrays {
  std::vector<Vec3> points;
  std::vector<std::uint8_t> types;  ///< VTK's numbers, one for each cell
  std::vector<std::int64_t> offsets, connectivity;
  std::vector<double> labels;  ///< one for each cell
};

/// VTK's wedge has its first triangle's normal pointing away from the second; Verdict's, and ours, towards
/// it.
inline constexpr std::size_t kWedgeOrder[6] = {0, 2, 1, 3, 5, 4};

/// The mesh of a grid: cells of lower dimension are left out. Throws InputError, which begins with `subject`,
/// for arrays whose lengths do not go together, a cell with another number of nodes than its type has, a node
/// that is not there, a coordinate that is no finite number, a label that is no 32-bit integer, cells that
/// are known neither as volumes nor as their boundaries, and a grid without volume cells.
Mesh mesh_of_grid(const GridArrays& grid, const std::string& subject);

}  // namespace cbc3d
