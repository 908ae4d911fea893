// The hexahedra of a mesh that is improved: their stars are chosen in the mesh of the lattice, stay as they
// are while the tets around them are improved and decimated, and are merged at the end.
//
// Notation: star, centre  as in mix_elements.hpp;
//           spacing       of a star: the length of its longest edge, which is the edge of its hex, mm;
//           depth         of a vertex: its distance from the nearest vertex of an interface or surface, mm;
//           core          the stars that are chosen, all together; the rest of the mesh is the band.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "mesher/mixed/mix_elements.hpp"

namespace cbc3d {

/// What the improvement will make of the band; lengths in mm.
struct HexCoreOptions {
  double surface_edge_mm = 1;  ///< mean length of the edges of surfaces
  /// Growth of inner edges for each mm of depth; below 0: no limit (ImproveOptions::gradation).
  double gradation = 1;
  /// Inner edges grow no longer than this.
  double longest_mm = std::numeric_limits<double>::infinity();
  /// The same for each material; empty: no further limit.
  std::span<const double> longest_of_material_mm = {};
};

struct HexCore {
  std::vector<Vec3> centres;        ///< of the hexes, local mm
  std::vector<std::uint8_t> fixed;  ///< for each vertex of the mesh: it belongs to the core and must stay
  /// By how much the number of cells falls when the core is merged.
  std::size_t cells_saved = 0;
};

/// Chooses the uniform stars that lie two layers of tets away from every interface and are coarse: a hex
/// there does not need more vertices than tets of the length that the gradation allows. Deterministic.
HexCore choose_hex_core(const MaterialMesh& mesh, const HexCoreOptions& options, const MixOptions& mix);

/// Merges the core in the improved mesh, where vertices may have other numbers but the fixed ones have their
/// places; stars that are not as they were stay tets.
MixReport merge_hex_core(MaterialMesh& mesh, const HexCore& core, const MixOptions& mix);

}  // namespace cbc3d
