// Stage "Mixed Element Mesh" of the paper: merges clusters of tets in uniform regions into hexes, with
// pyramids between the hexes and the remaining tets.
//
// Notation: star    the tets around a vertex; uniform when they are 24 red ones of one material that close
//                   around it;
//           centre  a vertex with a uniform star: 6 of its 14 neighbours lie on its axes (4 tets each), 8 are
//                   the corners (6 tets each) of the hex that replaces the star's inner half;
//           quad    the four corners around an axis: a face of the hex. Across it lies either the hex of the
//                   axis neighbour or a pyramid whose apex that neighbour is, with the triangles that the
//                   tets had there.
#pragma once

#include <span>

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct MixOptions {
  bool red_only = true;              ///< merge only undeformed red tets, as the paper does
  double min_scaled_jacobian = 0.2;  ///< of the hexes and pyramids made; matters where the mesh is deformed
};

struct MixReport {
  std::size_t centres = 0;  ///< vertices with a uniform star
  std::size_t hexes = 0;
  std::size_t pyramids = 0;
  std::size_t tets_merged = 0;
  std::size_t vertices_before = 0;
  std::size_t vertices_after = 0;
};

/// Merges what can be merged of a mesh of tets. Centres and corners of a BCC region take turns, so of each
/// connected region the larger of its two interlaced cubic lattices becomes hexes. Surfaces and interfaces
/// keep their facets; inner vertices that no cell uses any more are dropped.
MixReport mix_elements(MaterialMesh& mesh, const MixOptions& options);

/// The centres whose stars `mix_elements` would merge, ascending, when only vertices with a nonzero entry in
/// `allowed` may be centres; `allowed` has one entry for each vertex.
std::vector<VertexId> choose_centres(const MaterialMesh& mesh, const MixOptions& options,
                                     std::span<const std::uint8_t> allowed);

/// Merges the stars of the given centres, each only while it is uniform and good; MixReport::centres counts
/// those. Of two centres that are corners of each other's hex the first is merged.
MixReport merge_stars(MaterialMesh& mesh, const MixOptions& options, std::span<const VertexId> centres);

}  // namespace cbc3d
