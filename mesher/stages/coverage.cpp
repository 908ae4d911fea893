#include "mesher/stages/coverage.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace cbc3d {

std::vector<SurfaceVertex> surface_vertices(const TetNodes& tets,
                                            const std::vector<std::array<TetId, 4>>& neighbours,
                                            const std::vector<MaterialId>& materials) {
  std::vector<SurfaceVertex> found;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (materials[t] == kBackground) {
      continue;
    }
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId across = neighbours[t][n];
      if (across == kNoTet || materials[across] != materials[t]) {
        for (const std::uint8_t corner : kTetFace[n]) {
          found.push_back({tets[t][corner], materials[t]});
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

BoundaryCoverage::BoundaryCoverage(const LabelImage& image)
    : image_(image), state_(image.voxels.size(), kInterior), across_(image.voxels.size(), 0) {
  const auto& size = image.frame.size;
#pragma omp parallel for schedule(static)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (image.at(i, j, k) != kBackground && is_boundary_voxel(image, i, j, k)) {
          state_[image.frame.offset(i, j, k)] = kUncovered;
        }
      }
    }
  }
  for (std::size_t v = 0; v < state_.size(); ++v) {
    if (state_[v] == kUncovered) {
      boundary_.push_back(v);
    }
  }
}

void BoundaryCoverage::update(const std::vector<SurfaceVertex>& surface, const std::vector<Vec3>& points,
                              double distance_mm) {
  for (const std::size_t v : boundary_) {
    state_[v] = kUncovered;
  }
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t s = 0; s < surface.size(); ++s) {
    cover_around(points[surface[s].vertex], surface[s].material, distance_mm);
  }
  mark_across();
}

void BoundaryCoverage::mark_across() {
  std::fill(across_.begin(), across_.end(), 0);
  for (const std::size_t v : boundary_) {
    if (!is_uncovered(v)) {
      continue;
    }
    const Index3 at = image_.frame.index_of(v);
    for (std::size_t n = 0; n < 6; ++n) {
      Index3 across = at;
      across[n / 2] += n % 2 == 0 ? -1 : 1;
      if (image_.frame.contains(across[0], across[1], across[2])) {
        const std::size_t w = image_.frame.offset(across[0], across[1], across[2]);
        across_[w] |= static_cast<std::uint8_t>(image_.voxels[w] != image_.voxels[v]);
      }
    }
  }
}

void BoundaryCoverage::cover_around(const Vec3& centre_mm, MaterialId material, double distance_mm) {
  const ImageFrame& frame = image_.frame;
  Index3 low;
  Index3 high;
  for (int d = 0; d < 3; ++d) {
    const auto axis = static_cast<std::size_t>(d);
    low[axis] = std::max(0, static_cast<int>(std::ceil((centre_mm[d] - distance_mm) / frame.spacing_mm[d])));
    high[axis] = std::min(frame.size[axis] - 1,
                          static_cast<int>(std::floor((centre_mm[d] + distance_mm) / frame.spacing_mm[d])));
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        const std::size_t v = frame.offset(i, j, k);
        if (image_.voxels[v] == material &&
            (frame.local_centre(i, j, k) - centre_mm).squared_norm() <= distance_mm * distance_mm) {
          // Several threads may cover the same voxel; they write the same value.
          std::atomic_ref<std::uint8_t> state(state_[v]);
          if (state.load(std::memory_order_relaxed) == kUncovered) {
            state.store(kCovered, std::memory_order_relaxed);
          }
        }
      }
    }
  }
}

std::size_t BoundaryCoverage::uncovered_count() const {
  return static_cast<std::size_t>(
      std::count_if(boundary_.begin(), boundary_.end(), [this](std::size_t v) { return is_uncovered(v); }));
}

}  // namespace cbc3d
