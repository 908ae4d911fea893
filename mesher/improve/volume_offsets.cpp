#include "mesher/improve/volume_offsets.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/surface/volume_correction.hpp"

namespace cbc3d {

void VolumeOffsets::update(const MaterialMesh& mesh) {
  constexpr double kLargestFactor = 3;
  const double most_mm = 0.5 * std::cbrt(domain_.cell_mm3());
  const std::vector<double>& wanted_mm3 = domain_.volumes_mm3();
  const Extent extent = extent_of_materials(mesh, offset_mm_.size());
  for (std::size_t m = 1; m < offset_mm_.size(); ++m) {
    if (extent.area_mm2[m] > 0) {
      const double lack = wanted_mm3[m] - extent.volume_mm3[m];
      const double left = lack_mm3_[m] != 0 ? lack / lack_mm3_[m] : 0;
      const double factor = left > 0 && left < 1 ? std::min(kLargestFactor, 1 / (1 - left)) : 1;
      offset_mm_[m] = std::clamp(offset_mm_[m] + factor * lack / extent.area_mm2[m], -most_mm, most_mm);
      lack_mm3_[m] = lack;
    }
  }
}

double largest_volume_error(const MaterialMesh& mesh, const Domain& domain, double smallest_mm3) {
  const std::vector<double>& wanted_mm3 = domain.volumes_mm3();
  const Extent extent = extent_of_materials(mesh, wanted_mm3.size());
  double largest = 0;
  for (std::size_t m = 1; m < wanted_mm3.size(); ++m) {
    if (wanted_mm3[m] > smallest_mm3) {
      largest = std::max(largest, std::fabs(wanted_mm3[m] - extent.volume_mm3[m]) / wanted_mm3[m]);
    }
  }
  return largest;
}

}  // namespace cbc3d
