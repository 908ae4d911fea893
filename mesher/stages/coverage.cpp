#include "mesher/stages/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/voxel_rows.hpp"
#include "mesher/stages/cubes.hpp"

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

namespace {

/// Surface vertices in cubes, so that one near a place is found without looking at the others.
class VertexCubes {
 public:
  VertexCubes(const ImageFrame& frame, const std::vector<SurfaceVertex>& surface,
              const std::vector<Vec3>& points, double distance_mm)
      // Finer cubes than a few voxels would cost memory and tell little more.
      : distance_mm_(distance_mm), cubes_(frame, std::max(distance_mm, 4 * frame.spacing_mm.max_coeff())) {
    first_.assign(cubes_.count() + 1, 0);
    for (const SurfaceVertex& s : surface) {
      ++first_[cubes_.number(cubes_.cube_of(points[s.vertex])) + 1];
    }
    for (std::size_t c = 0; c + 1 < first_.size(); ++c) {
      first_[c + 1] += first_[c];
    }
    places_.resize(surface.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const SurfaceVertex& s : surface) {
      places_[next[cubes_.number(cubes_.cube_of(points[s.vertex]))]++] = {points[s.vertex], s.material};
    }
  }

  /// True when a vertex of the material lies within the distance of x.
  [[nodiscard]] bool is_near(const Vec3& x, MaterialId material) const {
    const Index3 own = cubes_.cube_of(x);
    if (is_near_in(cubes_.number(own), x, material)) {
      return true;
    }
    const Index3 low = cubes_.cube_of(x - Vec3{distance_mm_, distance_mm_, distance_mm_});
    const Index3 high = cubes_.cube_of(x + Vec3{distance_mm_, distance_mm_, distance_mm_});
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          if (Index3{i, j, k} != own && is_near_in(cubes_.number({i, j, k}), x, material)) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  struct Place {
    Vec3 at;
    MaterialId material;
  };

  [[nodiscard]] bool is_near_in(std::size_t cube, const Vec3& x, MaterialId material) const {
    return std::any_of(
        places_.begin() + first_[cube], places_.begin() + first_[cube + 1], [&](const Place& place) {
          return place.material == material && (x - place.at).squared_norm() <= distance_mm_ * distance_mm_;
        });
  }

  double distance_mm_;
  ImageCubes cubes_;
  std::vector<std::uint32_t> first_;
  std::vector<Place> places_;
};

}  // namespace

void BoundaryCoverage::update(const std::vector<SurfaceVertex>& surface, const std::vector<Vec3>& points,
                              double distance_mm) {
  const VertexCubes cubes(image_.frame, surface, points, distance_mm);
  std::vector<std::uint8_t> covered(boundary_.size());
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t b = 0; b < boundary_.size(); ++b) {
    const Index3 at = image_.frame.index_of(boundary_[b]);
    covered[b] =
        cubes.is_near(image_.frame.local_centre(at[0], at[1], at[2]), image_.voxels[boundary_[b]]) ? 1 : 0;
  }
  uncovered_.clear();
  uncovered_count_ = 0;
  for (std::size_t b = 0; b < boundary_.size(); ++b) {
    if (covered[b] == 0) {
      uncovered_.set(boundary_[b]);
      ++uncovered_count_;
    }
  }
  mark_across();
}

void BoundaryCoverage::mark_across() {
  across_.clear();
  uncovered_.for_each(0, image_.frame.voxel_count(), [&](std::size_t v) {
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
  });
}

bool BoundaryCoverage::wants_refinement(int j, int k, int i_begin, int i_end) const {
  const std::size_t begin = image_.frame.offset(i_begin, j, k), end = image_.frame.offset(i_end, j, k);
  return uncovered_.any(begin, end) || across_.any(begin, end);
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
