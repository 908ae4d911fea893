// The facets of a mesh's interfaces as the named groups that a file lists.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh_formats/file_mesh.hpp"

namespace cbc3d {

struct SurfaceGroup {
  std::string name;
  const std::vector<CellFacet>* facets = nullptr;
  Label label = 0;  ///< whose cells the facets belong to
};

/// One group for each interface of the mesh, then, where its nodes are split, one for the other side of each
/// interface between two labels.
std::vector<SurfaceGroup> surface_groups(const FileMesh& mesh, const LabelNames& names);

/// Facets of all groups with so many corners.
std::size_t facets_with(const FileMesh& mesh, const std::vector<SurfaceGroup>& groups, std::size_t corners);

/// Corners of a facet that has so many nodes.
inline constexpr std::size_t corners_of_facet(std::size_t nodes) {
  return nodes == 4 ? 4 : 3;
}

}  // namespace cbc3d
