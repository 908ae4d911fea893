// Where the outer surface of a mesh cuts itself, as across a gap thinner than the surface's error, and how it
// is drawn apart. Inside, where tets fill both sides, nothing can cross while all tets are positive.
#pragma once

#include "mesher/improve/surface/covered_samples.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct CrossingOptions {
  double step_mm = 0.1;          ///< a vertex retreats so far a round, or half or a quarter of it
  double goal_sine_squared = 0;  ///< no tet's worst angle falls below this, or below what it was
  int rounds = 12;               ///< at most
};

/// Pairs of facets of the outer surface that cross or touch without sharing a vertex, or that share one and
/// cross away from it; indices into `facets`, each pair once, ascending. Rounding may add pairs that nearly
/// touch. Parallel.
std::vector<std::array<std::uint32_t, 2>> crossing_facets(const std::vector<Vec3>& points,
                                                          const std::vector<std::array<VertexId, 3>>& facets);

/// The same of two facets.
bool facets_cross(const std::vector<Vec3>& points, const std::array<VertexId, 3>& f,
                  const std::array<VertexId, 3>& g);

/// True when two facets of the outer surface share an edge and one lies, along it, within the tet behind the
/// other: the outside is folded over there, as where a gap of one tet is turned inside out. `behind_f` and
/// `behind_g` are the tets' fourth vertices.
bool facets_fold(const std::vector<Vec3>& points, const std::array<VertexId, 3>& f, VertexId behind_f,
                 const std::array<VertexId, 3>& g, VertexId behind_g);

/// How many pairs of facets between labels, or on the outer surface, cross. Where a gap is turned inside out
/// by facets that share an edge, no outer ones cross, but others do. `label_of`: the label of each material.
std::size_t count_crossings_of_labels(const MaterialMesh& mesh, const std::vector<MaterialId>& label_of);

/// Draws the vertices of crossing facets, and of facets with an edge in common round which the tets fill more
/// than a full turn, back into their own tets until there are none; their points stay within reach. Returns
/// the pairs left.
std::size_t separate_crossings(MaterialMesh& mesh, const CoveredSamples& hosted,
                               const CrossingOptions& options);

}  // namespace cbc3d
