#include "baselines/podm/adapter.hpp"

namespace cbc3d::baselines {

std::vector<Adapter> podm_adapters() {
  const Adapter mesher{
      .name = "podm",
      .description =
          "Parallel optimistic Delaunay meshing, this project's implementation on CGAL's triangulation",
      .licence = "GPL-3.0-or-later",
      .deterministic = false,
      .multithreaded = true,
      // The paper's parameter of this mesher is delta.
      .parameters =
          {{"radius-edge-ratio", "2", "", "largest circumradius to shortest edge ratio of a tet"},
           {"delta", "voxel", "mm",
            "sampling density of the surface; voxel: 1.2 times the edge of a cube as large as a voxel"},
           {"facet-angle", "30", "deg", "smallest angle allowed in a surface facet"},
           {"size", "0", "mm", "largest circumradius of a tet; 0: none"},
           {"min-dihedral", "5", "deg",
            "dihedral angle below which a tet is split where that is possible; not in the publications"},
           {"surface", "voxels", "voxels|smooth",
            "the boundary that is sampled: the voxels' faces, or smooth boundaries between their centres"},
           {"remove-free", "true", "true|false",
            "remove free vertices within 2 delta of a new surface vertex (rule 6)"},
           {"removal-cap", "10", "", "the most of such removals for each surface vertex, on average"}},
  };
  return {program_adapter(
      mesher, {.parameter = "delta", .exponent = -2.6, .first = 1.2, .lowest = 0.005, .highest = 1000},
      "built without CGAL: install libcgal-dev and libtbb-dev and build again")};
}

}  // namespace cbc3d::baselines
