// Self-intersections of the outer surface of a mesh, as across a gap thinner than the surface's error: how
// they are found, and how they are separated. Inside, where tets fill both sides, nothing can intersect while
// all tets are positive.
#pragma once

#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct SeparationOptions {
  double step_mm = 0.1;     ///< the step of a vertex in one round; a half or a quarter of it where that fails
  double goal_quality = 0;  ///< no tet's worst angle falls below this, or below what it was
  int rounds = 12;          ///< at most
};

/// Pairs of facets that intersect or touch without sharing a vertex, or that share one and intersect away
/// from it; indices into `facets`, each pair once, ascending. Rounding may add pairs that nearly touch.
/// Parallel.
std::vector<std::array<std::uint32_t, 2>> intersecting_facets(
    const std::vector<Vec3>& points, const std::vector<std::array<VertexId, 3>>& facets);

/// The same test for two facets.
bool facets_intersect(const std::vector<Vec3>& points, const std::array<VertexId, 3>& f,
                      const std::array<VertexId, 3>& g);

/// True when two facets of the outer surface share an edge and one lies, along it, within the tet behind the
/// other: the outside is folded over there, as where a gap of one tet is turned inside out. `behind_f` and
/// `behind_g` are the tets' fourth vertices.
bool facets_fold(const std::vector<Vec3>& points, const std::array<VertexId, 3>& f, VertexId behind_f,
                 const std::array<VertexId, 3>& g, VertexId behind_g);

/// The number of pairs of facets between labels, or on the outer surface, that intersect. Where a gap is
/// turned inside out by facets that share an edge, no outer ones intersect, but others do. `label_of`: the
/// label of each material.
std::size_t count_self_intersections(const MaterialMesh& mesh, const std::vector<MaterialId>& label_of);

/// Moves the vertices of intersecting facets inwards, into their own tets, until there are none; likewise
/// those of facets with a common edge around which the tets fill more than a full turn. Covered samples stay
/// covered. Returns the number of pairs left.
std::size_t separate_self_intersections(MaterialMesh& mesh, const SurfaceCover& cover,
                                        const SeparationOptions& options);

}  // namespace cbc3d
