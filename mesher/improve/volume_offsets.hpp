// The offsets by which the improvement moves a domain's boundaries outwards, so that each material gets its
// volume: all smooth surfaces lose some. They are the improver's own state; the domain does not change.
#pragma once

#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

class VolumeOffsets {
 public:
  /// `domain` must outlive this.
  explicit VolumeOffsets(const Domain& domain)
      : domain_(domain), offset_mm_(domain.labels().size(), 0.0), lack_mm3_(offset_mm_.size(), 0.0) {}

  /// Of every material; positive: outwards.
  [[nodiscard]] const std::vector<double>& offset_mm() const { return offset_mm_; }
  /// Moves the boundaries by what each material of the mesh lacks in volume over the area of its surface, at
  /// most half the edge of a cell in all. Where the last update brought less than it should have, this one
  /// moves farther.
  void update(const MaterialMesh& mesh);

 private:
  const Domain& domain_;
  std::vector<double> offset_mm_;
  std::vector<double> lack_mm3_;  // at the last update
};

/// The largest error of a material's volume, as a share of it; volumes up to `smallest_mm3` do not count.
double largest_volume_error(const MaterialMesh& mesh, const Domain& domain, double smallest_mm3);

}  // namespace cbc3d
