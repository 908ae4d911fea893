#include "mesher/stages/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

namespace {

/// Those of the tets [begin, end), each once.
std::vector<SurfaceVertex> surface_vertices_of(const TetNodes& tets,
                                               const std::vector<std::array<TetId, 4>>& neighbours,
                                               const std::vector<MaterialId>& materials, std::size_t begin,
                                               std::size_t end) {
  std::vector<SurfaceVertex> found;
  for (std::size_t t = begin; t < end; ++t) {
    for (std::size_t n = 0; n < 4 && materials[t] != kBackground; ++n) {
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

}  // namespace

std::vector<SurfaceVertex> surface_vertices(const TetNodes& tets,
                                            const std::vector<std::array<TetId, 4>>& neighbours,
                                            const std::vector<MaterialId>& materials) {
  constexpr std::size_t kChunk = 16384;
  std::vector<std::vector<SurfaceVertex>> chunks((tets.size() + kChunk - 1) / kChunk);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    chunks[c] =
        surface_vertices_of(tets, neighbours, materials, c * kChunk, std::min(tets.size(), (c + 1) * kChunk));
  }
  std::vector<SurfaceVertex> all;
  for (const auto& chunk : chunks) {
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  return all;
}

BoundaryCoverage::BoundaryCoverage(const LabelImage& image)
    : image_(image), uncovered_(image.voxels.size()), across_(image.voxels.size()) {
  const auto& size = image.frame.size;
  const BoundaryRows rows(image);
  std::vector<std::vector<std::size_t>> slices(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(static)
  for (int k = 0; k < size[2]; ++k) {
    std::vector<int> found;
    for (int j = 0; j < size[1]; ++j) {
      found.clear();
      rows.find(j, k, found);
      for (const int i : found) {
        slices[static_cast<std::size_t>(k)].push_back(image.frame.offset(i, j, k));
      }
    }
  }
  for (auto& slice : slices) {
    boundary_.insert(boundary_.end(), slice.begin(), slice.end());
    slice = {};
  }
}

void BoundaryCoverage::update(const std::vector<SurfaceVertex>& surface, const std::vector<Vec3>& points,
                              double distance_mm) {
  for (const std::size_t v : boundary_) {
    uncovered_.set(v);
  }
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t s = 0; s < surface.size(); ++s) {
    cover_around(points[surface[s].vertex], surface[s].material, distance_mm);
  }
  mark_across();
}

void BoundaryCoverage::mark_across() {
  across_.clear();
  for (const std::size_t v : boundary_) {
    if (!uncovered_.test(v)) {
      continue;
    }
    const Index3 at = image_.frame.index_of(v);
    for (std::size_t n = 0; n < 6; ++n) {
      Index3 across = at;
      across[n / 2] += n % 2 == 0 ? -1 : 1;
      if (image_.frame.contains(across[0], across[1], across[2])) {
        const std::size_t w = image_.frame.offset(across[0], across[1], across[2]);
        if (image_.voxels[w] != image_.voxels[v]) {
          across_.set(w);
        }
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
    for (int j = low[1]; j <= high[1] && low[0] <= high[0]; ++j) {
      const std::size_t row = frame.offset(0, j, k);
      const auto first = row + static_cast<std::size_t>(low[0]);
      uncovered_.for_each(first, row + static_cast<std::size_t>(high[0]) + 1, [&](std::size_t v) {
        const Vec3 centre = frame.local_centre(static_cast<int>(v - row), j, k);
        if (image_.voxels[v] == material &&
            (centre - centre_mm).squared_norm() <= distance_mm * distance_mm) {
          uncovered_.reset(v);
        }
      });
    }
  }
}

bool BoundaryCoverage::wants_refinement(int j, int k, int i_begin, int i_end) const {
  const std::size_t begin = image_.frame.offset(i_begin, j, k), end = image_.frame.offset(i_end, j, k);
  return uncovered_.any(begin, end) || across_.any(begin, end);
}

std::size_t BoundaryCoverage::uncovered_count() const {
  return static_cast<std::size_t>(std::count_if(boundary_.begin(), boundary_.end(),
                                                [this](std::size_t v) { return uncovered_.test(v); }));
}

InterfaceCoverage::InterfaceCoverage(const LabelImage& image)
    : image_(image), interfaces_(interface_points(image)), wanted_(image.frame.voxel_count()) {}

void InterfaceCoverage::update(const std::vector<MaterialSet>& sets, const std::vector<Vec3>& points,
                               double distance_mm) {
  wanted_.clear();
  const std::vector<std::size_t> missing = renew_hosts(interfaces_, points, sets, distance_mm, hosts_);
  uncovered_ = missing.size();
  for (const std::size_t p : missing) {
    want(interfaces_[p]);
  }
}

void InterfaceCoverage::want(const InterfacePoint& point) {
  const ImageFrame& frame = image_.frame;
  Index3 at;
  for (int axis = 0; axis < 3; ++axis) {
    at[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::lround(point.centre()[axis] / frame.spacing_mm[axis]));
  }
  wanted_.set(frame.offset(at[0], at[1], at[2]));
  for (std::size_t n = 0; n < 6; ++n) {
    Index3 across = at;
    across[n / 2] += n % 2 == 0 ? -1 : 1;
    if (frame.contains(across[0], across[1], across[2]) &&
        image_.at(across[0], across[1], across[2]) == point.other) {
      wanted_.set(frame.offset(across[0], across[1], across[2]));
    }
  }
}

}  // namespace cbc3d
