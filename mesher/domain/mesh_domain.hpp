// The domain of a given mesh: its own surfaces are the reference for its improvement where there is no image.
//
// Notation: reference  the facets between two materials of the mesh as it was. The nearest place on them is
// exact
//                      (Ericson, Real-Time Collision Detection, 2005, 5.1.5); it is found in a tree of boxes,
//                      one tree for each pair of materials.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

class MeshDomain : public Domain {
 public:
  /// Keeps a copy of what it needs. `labels` has the label of every material, [0] that of background; no two
  /// materials share a label. Throws JobError where a face belongs to more than two tets.
  MeshDomain(const MaterialMesh& mesh, std::vector<Label> labels);
  ~MeshDomain() override;

  [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
  [[nodiscard]] const std::vector<MaterialId>& label_of() const override { return label_of_; }
  [[nodiscard]] const std::vector<double>& volumes_mm3() const override { return volumes_mm3_; }
  /// Mean length of the facets' sides; 0 without facets.
  [[nodiscard]] double scale_mm() const override { return mean_edge_mm_; }
  /// The volume of a regular tet with sides of the scale.
  [[nodiscard]] double cell_mm3() const override {
    return mean_edge_mm_ * mean_edge_mm_ * mean_edge_mm_ / (6 * std::sqrt(2.0));
  }
  [[nodiscard]] double thin_reach_mm() const override { return std::numeric_limits<double>::infinity(); }

  /// Infinite deviation where the mesh had no facet between the two materials.
  [[nodiscard]] BoundaryDistance boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const override;
  [[nodiscard]] bool is_thin(const BoundarySample& /*sample*/) const override { return false; }
  [[nodiscard]] std::vector<VertexId> covering_vertices(double reach_mm) const override;

  /// Decided by the side of the nearest facet, which may err within a facet's size of an edge or a vertex
  /// where more than two materials meet.
  [[nodiscard]] MaterialId material_at(const Vec3& x) const override;
  [[nodiscard]] std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId material) const override;
  [[nodiscard]] bool is_near_boundary(const Vec3& x, MaterialId material) const override;

 protected:
  /// The vertices of the surfaces and the centres of their facets.
  [[nodiscard]] std::vector<BoundarySample> find_samples() const override { return own_samples_; }

 private:
  class FacetTree;
  /// A facet, its right-hand normal towards the higher material.
  struct Facet {
    std::array<VertexId, 3> nodes;
    MaterialId lower, higher;
  };
  static std::vector<Facet> facets_of(const MaterialMesh& mesh);
  void add_volumes(const MaterialMesh& mesh);
  void add_samples(const MaterialMesh& mesh, const std::vector<Facet>& facets);

  std::vector<Label> labels_;
  std::vector<MaterialId> label_of_;
  std::vector<double> volumes_mm3_;
  std::map<std::pair<MaterialId, MaterialId>, std::unique_ptr<FacetTree>> trees_;  // by lower, higher
  std::vector<BoundarySample> own_samples_;
  std::vector<VertexId> nearest_;  // of each sample
  std::vector<double> to_nearest_mm_;
  double mean_edge_mm_ = 0;
};

}  // namespace cbc3d
