#include "mesher/mesh_formats/surface_groups.hpp"

namespace cbc3d {

std::vector<SurfaceGroup> surface_groups(const FileMesh& mesh, const LabelNames& names) {
  std::vector<SurfaceGroup> groups;
  for (const Interface& interface : mesh.interfaces()) {
    groups.push_back({interface_name(interface, names), &interface.facets, interface.label});
  }
  if (mesh.is_split()) {
    for (const Interface& interface : mesh.interfaces()) {
      if (!interface.other) continue;
      groups.push_back({interface_name(interface, names, true), &interface.opposite, *interface.other});
    }
  }
  return groups;
}

std::size_t facets_with(const FileMesh& mesh, const std::vector<SurfaceGroup>& groups, std::size_t corners) {
  std::size_t count = 0;
  std::array<VertexId, 6> nodes;
  for (const SurfaceGroup& group : groups) {
    for (const CellFacet& facet : *group.facets) {
      count += corners_of_facet(mesh.nodes_of(facet, nodes)) == corners ? 1 : 0;
    }
  }
  return count;
}

}  // namespace cbc3d
