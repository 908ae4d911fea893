// The last resort where labels come within a voxel of each other: single tets change hands.
//
// A tip of one label that reaches into another, or over a gap, leaves a vertex on a surface where the image
// has none, and outer facets that cut each other. Where a step of that vertex does not mend it, for it
// belongs to both sides, the tets of the tip become their neighbour's or are left out, as long as every
// surface stays a manifold, every vertex near the boundary of its labels, and every interface point within
// reach.
#pragma once

#include <functional>
#include <optional>

#include "mesher/improve/surface/covered_samples.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// What the image says of a place.
struct ImagePlaces {
  /// The first material of each one's label: a label may have several, one a region.
  std::vector<MaterialId> label_of;
  /// True when the boundary of a material's label (of all labels together, for background) is near enough to
  /// a place.
  std::function<bool(const Vec3& local_mm, MaterialId material)> is_near;
  /// Where that boundary is, if anywhere near.
  std::function<std::optional<Vec3>(const Vec3& local_mm, MaterialId material)> nearest;
  /// The material that the image has there.
  std::function<MaterialId(const Vec3& local_mm)> material_at;
};

struct RelabelOptions {
  double reach_mm = 1;     ///< unit of the steps of vertices
  double largest_mm3 = 8;  ///< no more than this changes hands at one place
  double goal_sine_squared =
      0;           ///< where a vertex moves, no tet's worst angle falls below this, or below what it was
  int rounds = 6;  ///< at most
};

struct RelabelReport {
  std::size_t strays = 0;          ///< vertices far from the boundary of one of their labels, before
  std::size_t pinches = 0;         ///< vertices where a label's surface was no manifold, before
  std::size_t crossings = 0;       ///< pairs of outer facets that cut each other, before
  std::size_t vertices_moved = 0;  ///< strays that a small step has mended
  std::size_t tets_relabelled = 0;
  std::size_t faults_left = 0;  ///< strays, pinches and crossings that the last round has found
};

/// Relabels tets of `mesh`; those that become background are taken out. Vertices keep their numbers.
/// Deterministic.
RelabelReport relabel_misplaced_tets(MaterialMesh& mesh, CoveredSamples& hosted, const ImagePlaces& places,
                                     const RelabelOptions& options);

}  // namespace cbc3d
