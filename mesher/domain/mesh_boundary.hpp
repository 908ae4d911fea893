// The boundary that a mesh itself has, as the reference for its improvement where there is no image.
//
// Notation: reference  the facets between two materials of the mesh as it was; the nearest place on them is
// exact
//                      (Ericson, Real-Time Collision Detection, 2005, 5.1.5), found in a tree of boxes a
//                      pair.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mesher/domain/boundary.hpp"
#include "mesher/domain/interface_points.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

class MeshBoundary : public Boundary {
 public:
  /// Keeps a copy of what it needs. Throws JobError where a face belongs to more than two tets.
  explicit MeshBoundary(const MaterialMesh& mesh);
  ~MeshBoundary() override;

  /// Infinite deviation where the mesh had no facet between the two materials.
  [[nodiscard]] BoundarySample sample(const Vec3& x, MaterialId a, MaterialId b) const override;

  /// The surface's vertices and the centres of its facets, with the materials they part.
  [[nodiscard]] const std::vector<InterfacePoint>& points() const { return points_; }
  /// A vertex of the mesh that stands for each point, kNoVertex where it is farther away than the reach.
  [[nodiscard]] std::vector<VertexId> hosts(double reach_mm) const;
  /// Mean length of the facets' sides, mm; 0 without facets.
  [[nodiscard]] double mean_edge_mm() const { return mean_edge_mm_; }

 private:
  class FacetTree;
  /// A facet, its right-hand normal towards the higher material.
  struct Facet {
    std::array<VertexId, 3> nodes;
    MaterialId lower, higher;
  };
  static std::vector<Facet> facets_of(const MaterialMesh& mesh);
  void add_points(const MaterialMesh& mesh, const std::vector<Facet>& facets);

  std::map<std::pair<MaterialId, MaterialId>, std::unique_ptr<FacetTree>> trees_;  // by lower, higher
  std::vector<InterfacePoint> points_;
  std::vector<VertexId> nearest_;  // of each point
  std::vector<double> to_nearest_mm_;
  double mean_edge_mm_ = 0;
};

}  // namespace cbc3d
