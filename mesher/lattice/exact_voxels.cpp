#include "mesher/lattice/exact_voxels.hpp"

#include <algorithm>

#include "mesher/domain/simple_point.hpp"

namespace cbc3d {

void ExactVoxels::add(const std::vector<std::size_t>& places, const std::vector<std::size_t>& misplaced) {
  for (const std::size_t place : places) {
    (is_exact_.test(place) ? is_stubborn_ : is_exact_).set(place);
  }
  for (const std::size_t place : places) {
    const Index3 at = frame_.index_of(place);
    for (std::size_t n = 0; n < 27; ++n) {
      const Index3 next = voxel_neighbour(at, n);
      if (!frame_.contains(next[0], next[1], next[2])) {
        continue;
      }
      const std::size_t offset = frame_.offset(next[0], next[1], next[2]);
      if (std::binary_search(misplaced.begin(), misplaced.end(), offset)) {
        is_exact_.set(offset);
      }
    }
  }
}

bool ExactVoxels::holds(const Vec3& local_mm) const {
  return test(is_exact_, local_mm);
}

bool ExactVoxels::is_stubborn(const Vec3& local_mm) const {
  return test(is_stubborn_, local_mm);
}

bool ExactVoxels::test(const VoxelBits& bits, const Vec3& local_mm) const {
  const std::optional<Index3> at = frame_.voxel_at_local(local_mm);
  return at && bits.test(frame_.offset((*at)[0], (*at)[1], (*at)[2]));
}

}  // namespace cbc3d
