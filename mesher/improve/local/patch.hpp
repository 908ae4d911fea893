// A piece of a mesh that one thread improves by itself, with all that the operations on it need.
#pragma once

#include "mesher/domain/domain.hpp"
#include "mesher/improve/local/surface_cover.hpp"
#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

/// The limits that no operation may exceed, unless they were exceeded before.
struct Guards {
  double deviation_mm =
      0.3;  ///< of vertices, and of the centres and side middles of facets, from the boundary
  double least_cosine = 0.7071;  ///< of the angle between a facet and the boundary: 45 degrees
  double scale_mm = 1;           ///< distances from the boundary count in this unit
};

/// The domain's boundaries, moved outwards by an offset for each material: smooth surfaces lose volume, and
/// the offsets make up for it. Both must outlive this.
struct ShiftedBoundaries {
  const Domain& domain;
  std::span<const double> offset_mm = {};  ///< of every material; empty: nothing is moved

  [[nodiscard]] BoundaryDistance distance(const Vec3& x, MaterialId a, MaterialId b) const {
    const BoundaryDistance near = domain.boundary_distance(x, a, b);
    return offset_mm.empty() ? near : near.shifted(offset_mm[a] - offset_mm[b]);
  }
};

struct Patch {
  TetComplex mesh;
  SurfaceCover cover;
  std::vector<MaterialSet> sets;  ///< materials of the stars; size 0 at locked vertices
  ShiftedBoundaries boundaries;
  Guards guards;

  [[nodiscard]] bool on_boundary(VertexId v) const { return sets[v].size > 1; }
  /// Largest deviation of a facet's centre and of the middles of its sides from the boundary.
  [[nodiscard]] double facet_deviation(const Vec3& p, const Vec3& q, const Vec3& r, MaterialId inner,
                                       MaterialId outer) const;
  /// Cosine of the angle between a facet's normal (towards `outer`) and the boundary's at its centre; 1 where
  /// the boundary has none.
  [[nodiscard]] double facet_cosine(const Vec3& p, const Vec3& q, const Vec3& r, MaterialId inner,
                                    MaterialId outer) const;
  /// Renews `sets` for the nodes of tets that were put in.
  void renew_sets(std::span<const FreshTet> fresh);
  void renew_sets_of(std::span<const VertexId> vertices);

  /// Smoothing moves no vertex farther from a boundary of the material, mm; empty: no limit.
  std::span<const double> smoothness_cap_mm = {};
  /// No inner vertex vanishes for edges longer than the mean of this at their ends, mm; empty: no limit.
  std::vector<double> longest_mm = {};
  /// Collapses at a vertex on an interface leave no edge longer than this, mm; empty: no limit.
  std::vector<double> longest_on_interface_mm = {};

  // Scratch of the operations.
  std::vector<TetId> star = {}, star_other = {};
  std::vector<FacetAt> facets = {}, facets_other = {};
  std::vector<VertexId> around = {}, around_other = {};
  std::vector<FreshTet> fresh = {};
  EdgeRing ring = {}, ring_other = {};
};

}  // namespace cbc3d
