// The guards of the distances between the surfaces of mesh and image, in both directions, at every merge.
//
// Image to mesh: the boundary of the image is a list of triangular pieces, each with a facet of the mesh
// between the same two materials that is near all of it: the distance from a convex facet is a convex
// function, so near the three corners of a piece is near all of it. A merge must find such a facet among the
// new ones for every piece of those that it changes; a piece may be cut in four for that. Mesh to image:
// every new facet must be near the voxels' faces between its two materials. It is cut until each part has a
// face that is near its three corners, and is refused when a part cannot be decided.
#pragma once

#include <limits>
#include <vector>

#include "baselines/ld/merge_guards.hpp"

namespace cbc3d::baselines::ld {

struct SurfaceDistanceBounds {
  double image_to_mesh_mm = 0;  ///< of any point of the image's boundary from the mesh's; more than 0
  double mesh_to_image_mm = 0;  ///< the other way
};

class DistanceGuard {
 public:
  /// Both bounds must be more than 0. `mesh` must be one with background, and have pieces; it and the grid
  /// must outlive the guard.
  DistanceGuard(const CellGrid& grid, MergeMesh& mesh, const SurfaceDistanceBounds& bounds);

  /// Takes the pieces at v's facets, for the questions that follow.
  void gather(VertexId v, const Fan& fan);
  /// True when the facets of v -> w keep both distances. Remembers which facets the pieces are near.
  bool accepts(VertexId w);
  /// Carries out what the last question found; call it with the merge.
  void merge();

 private:
  using Triangle = std::array<Vec3, 3>;
  struct NewFacet {
    FanFacet facet;
    Triangle corners;
  };
  struct OldPiece {
    std::uint32_t piece;
    MaterialId low, high;
  };
  // A piece, or a part of one, and the new facet that it is near.
  struct Assignment {
    std::uint32_t piece;
    std::array<LatticePoint, 3> corners;
    std::array<VertexId, 3> facet;
    bool is_first;  // of its piece
  };
  // A face of the grid: between a cell, relative to another, and the next along the axis.
  struct NearFace {
    Index3 cell;
    int axis;
  };

  [[nodiscard]] Vec3 mm_of(const LatticePoint& p) const {
    return {p[0] * half_mm_.x, p[1] * half_mm_.y, p[2] * half_mm_.z};
  }
  void list_near_faces();
  bool set_new_facets(VertexId w);
  bool assign(const OldPiece& old, const std::array<LatticePoint, 3>& corners, int depth, VertexId w);
  [[nodiscard]] double squared_distance_from_face(const Vec3& p, const Index3& c, int axis) const;
  [[nodiscard]] bool is_near_image(const Triangle& t, const FanFacet& facet, int depth) const;

  static constexpr std::uint32_t kEnd = 0xFFFFFFFFU;

  const CellGrid& grid_;
  MergeMesh& mesh_;
  double squared_image_to_mesh_, squared_mesh_to_image_;
  Vec3 half_mm_;
  std::vector<NearFace> near_faces_;         // the nearest first
  std::vector<std::uint32_t> first_, next_;  // lists of pieces at the first vertex of their facets
  VertexId v_ = kNoVertex;
  std::vector<FanFacet> fan_;
  std::vector<VertexId> owners_;
  std::vector<OldPiece> old_;
  std::vector<NewFacet> new_facets_;
  std::vector<Assignment> assignments_;
};

}  // namespace cbc3d::baselines::ld
