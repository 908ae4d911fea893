// The guards of a merge: what is around the vertex that would go, and whether the mesh stays valid, well
// shaped and of the same topology without it.
//
// Notation: v -> w  the merge that puts w in the place of its neighbour v;
//           fan     the facets between different materials (or on the outside of this part of the mesh) at a
//                   vertex, each by its two other vertices.
#pragma once

#include <vector>

#include "baselines/ld/dihedral.hpp"
#include "baselines/ld/merge_mesh.hpp"

namespace cbc3d::baselines::ld {

/// Stands for the material outside a part of the mesh.
inline constexpr MaterialId kOutside = 0xFFFF;

/// A facet at a vertex, by its two other vertices, the smaller number first, and its two materials likewise.
struct FanFacet {
  VertexId x = 0, y = 0;
  MaterialId low = 0, high = 0;
};

/// All facets between different materials at a vertex, ascending by their vertices.
class Fan {
 public:
  void gather(MergeMesh& mesh, VertexId v);
  [[nodiscard]] const std::vector<FanFacet>& facets() const { return facets_; }
  /// The vertices of the facets, ascending.
  [[nodiscard]] const std::vector<VertexId>& vertices() const { return vertices_; }
  /// Number of facets at the edge to x.
  [[nodiscard]] int degree(VertexId x) const;
  [[nodiscard]] bool has(VertexId x) const { return degree(x) > 0; }
  [[nodiscard]] bool has(VertexId x, VertexId y) const;

 private:
  struct Face {
    std::uint64_t key;  // both vertices, the smaller first
    MaterialId material;
  };

  std::vector<Face> faces_;
  std::vector<FanFacet> facets_;
  std::vector<VertexId> vertices_;
};

/// True when v -> w keeps the topology of all materials: the edge lies in the stratum of v, and no facet or
/// edge of the interfaces comes to lie on another, which is the link condition of their complex (Dey,
/// Edelsbrunner, Guha, Nekhayev: Topology preserving edge contraction, Publications de l'Institut
/// Mathematique 66, 1999). In the space around them the orientation of the tets says all, for the star of v
/// is filled again.
bool keeps_topology(Stratum stratum_of_v, const Fan& of_v, VertexId w, const Fan& of_w);

/// The tets around a vertex, prepared for the question whether another can take its place.
class Star {
 public:
  /// `half_cell_mm`: length of a lattice unit along each axis.
  explicit Star(const Vec3& half_cell_mm) : half_cell_mm_(half_cell_mm) {}

  void gather(MergeMesh& mesh, VertexId v);
  /// The vertices around v, the nearest first, equally near ones by their number.
  [[nodiscard]] const std::vector<VertexId>& neighbours() const { return neighbours_; }
  /// True when all tets that v -> w leaves are positive, and those of materials within the bounds.
  [[nodiscard]] bool accepts(const MergeMesh& mesh, VertexId w, const DihedralBounds& bounds) const;

 private:
  struct StarTet {
    std::array<VertexId, 3> link;  // such that v and they are positive
    std::array<std::int64_t, 3> normal;
    std::array<std::int64_t, 3> first;  // link[0] relative to v
    std::array<Vec3, 3> link_mm;        // relative to v
    MaterialId material;
  };

  [[nodiscard]] StarTet star_tet(const MergeMesh& mesh, TetId t, std::uint32_t node) const;
  void sort_neighbours(const MergeMesh& mesh);

  Vec3 half_cell_mm_;
  VertexId v_ = kNoVertex;
  std::vector<StarTet> tets_;
  std::vector<VertexId> neighbours_;
  std::vector<std::pair<double, VertexId>> by_distance_;
};

}  // namespace cbc3d::baselines::ld
