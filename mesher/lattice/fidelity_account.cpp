#include "mesher/lattice/fidelity_account.hpp"

#include <algorithm>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {
namespace {

constexpr unsigned kBits = 8;  // of ForeignMaterials

unsigned bit_of(std::size_t material) {
  return 1U << (material % kBits);
}

}  // namespace

ForeignMaterials FidelityAccount::enter(const std::array<LatticePoint, 4>& tet, MaterialId material,
                                        Changes& changes) const {
  return is_surely_pure(tet, material) ? ForeignMaterials{0} : count_foreign(tet, material, 1, changes);
}

void FidelityAccount::add(const Changes& changes) {
  for (std::size_t m = 0; m < voxels_.size(); ++m) {
    sums_.missing[m] += changes.missing[m];
    sums_.intruding[m] += changes.intruding[m];
  }
}

/// True when all voxels of the tet's box are of the material: far faster to see than which are in the tet.
bool FidelityAccount::is_surely_pure(const std::array<LatticePoint, 4>& tet, MaterialId material) const {
  LatticePoint low = tet[0];
  LatticePoint high = tet[0];
  for (const LatticePoint& p : tet) {
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], p[d]);
      high[d] = std::max(high[d], p[d]);
    }
  }
  const auto [x, y, z] = raster_.voxels_in_box(low, high);
  if (x[0] >= x[1]) {
    return true;
  }
  return image_.voxels.visit([&, x = x, y = y, z = z]<typename Voxel>(const Voxel* voxels) {
    for (int k = z[0]; k < z[1]; ++k) {
      for (int j = y[0]; j < y[1]; ++j) {
        if (!is_all_of(voxels + image_.frame.offset(0, j, k), x[0], x[1], static_cast<Voxel>(material))) {
          return false;
        }
      }
    }
    return true;
  });
}

ForeignMaterials FidelityAccount::count_foreign(const std::array<LatticePoint, 4>& tet, MaterialId material,
                                                std::ptrdiff_t sign, Changes& changes) const {
  unsigned foreign = 0;
  image_.voxels.visit([&](const auto* voxels) {
    raster_.for_each_row(tet, [&](int j, int k, int i_begin, int i_end) {
      const auto* row = voxels + image_.frame.offset(0, j, k);
      for (int i = i_begin; i < i_end; ++i) {
        if (row[i] != material) {
          changes.missing[row[i]] += sign;
          changes.intruding[material] += sign;
          foreign |= bit_of(row[i]);
        }
      }
    });
  });
  return static_cast<ForeignMaterials>(foreign);
}

bool FidelityAccount::is_misjudged(const std::array<LatticePoint, 4>& tet, MaterialId own,
                                   ForeignMaterials foreign, const std::vector<std::uint8_t>& unmet) const {
  if (foreign == 0 || unmet[own] != 0) {
    return foreign != 0;
  }
  unsigned wanted = 0;
  for (std::size_t m = 0; m < unmet.size(); ++m) {
    wanted |= unmet[m] != 0 ? bit_of(m) : 0U;
  }
  if ((foreign & wanted) == 0 || unmet.size() <= kBits) {
    return (foreign & wanted) != 0;
  }
  bool misjudged = false;  // several materials have a bit in common
  image_.voxels.visit([&](const auto* voxels) {
    raster_.for_each_row(tet, [&](int j, int k, int i_begin, int i_end) {
      const auto* row = voxels + image_.frame.offset(0, j, k);
      misjudged = std::any_of(row + i_begin, row + i_end, [&](MaterialId m) { return unmet[m] != 0; });
      return misjudged;
    });
  });
  return misjudged;
}

}  // namespace cbc3d
