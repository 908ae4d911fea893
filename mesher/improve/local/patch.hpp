// A piece of a mesh that one thread improves on its own, with all that the operations on it need.
#pragma once

#include "mesher/domain/boundary.hpp"
#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

/// What no operation may worsen beyond.
struct Guards {
  double deviation_mm =
      0.3;              ///< vertices, edges and centres of facets from the boundary, unless farther before
  double scale_mm = 1;  ///< distances from the boundary count in this unit
};

struct Patch {
  TetComplex mesh;
  SurfaceCover cover;
  std::vector<MaterialSet> sets;  ///< materials of the stars; size 0 at locked vertices
  const Boundary& boundary;
  Guards guards;

  [[nodiscard]] bool on_boundary(VertexId v) const { return sets[v].size > 1; }
  /// Largest deviation of a facet's centre and of the middles of its sides from the boundary.
  [[nodiscard]] double facet_deviation(const Vec3& p, const Vec3& q, const Vec3& r, MaterialId inner,
                                       MaterialId outer) const;
  /// Renews `sets` for the nodes of tets that were put in.
  void renew_sets(std::span<const FreshTet> fresh);
  void renew_sets_of(std::span<const VertexId> vertices);

  // Scratch of the operations.
  std::vector<TetId> star, star_other;
  std::vector<FacetAt> facets, facets_other;
  std::vector<VertexId> around, around_other;
  std::vector<FreshTet> fresh;
  EdgeRing ring, ring_other;

  /// No inner vertex vanishes for edges longer than the mean of this at their ends, mm; empty: no limit.
  std::vector<double> longest_mm = {};
};

}  // namespace cbc3d
