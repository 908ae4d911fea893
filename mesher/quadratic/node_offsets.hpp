// The offsets by which the nodes of curved edges leave the smooth boundary, so that the curved tets of every
// material have its volume together.
//
// Over a facet of six nodes the shape function of a corner integrates to nothing, that of an edge's node to a
// third of the facet. In first order the volume below a curved surface therefore depends on the edges' nodes
// alone, and all of them moved by d change it by d times the area.
#pragma once

#include <vector>

#include "mesher/domain/domain.hpp"

namespace cbc3d {

/// By how much a material's volume grows with an offset of its boundary to another material.
struct OffsetArea {
  MaterialId a = 0, b = 0;
  double area_mm2 = 0;
};

class NodeOffsets {
 public:
  /// `domain` must outlive this.
  explicit NodeOffsets(const Domain& domain) : domain_(domain), offset_mm_(domain.labels().size(), 0.0) {}

  /// By which nodes between a and b lie beyond the boundary, away from a.
  [[nodiscard]] double between_mm(MaterialId a, MaterialId b) const { return offset_mm_[a] - offset_mm_[b]; }
  /// True where the volume of a material is off although its nodes can move, and the last update at least
  /// halved an error that it found: where nodes are held back, or a part of the material is not in the mesh,
  /// it does not.
  [[nodiscard]] bool can_improve(const std::vector<double>& volume_mm3,
                                 const std::vector<OffsetArea>& areas) const;
  /// Changes the offsets so that in first order every material gains what its volume lacks, all interfaces
  /// at once; none is ever more than half the edge of a cell of the domain. At most one entry for two
  /// materials. Linear in the areas.
  void update(const std::vector<double>& volume_mm3, const std::vector<OffsetArea>& areas);

 private:
  const Domain& domain_;
  std::vector<double> offset_mm_;  // of every material, positive outwards; background keeps 0
  std::vector<double> lack_mm3_;   // at the last update; empty before the first
};

}  // namespace cbc3d
