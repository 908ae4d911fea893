#include "mesher/domain/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/voxel_rows.hpp"
#include "mesher/domain/cubes.hpp"

namespace cbc3d {

namespace {

/// The surface vertices of the tets [begin, end). A vertex is soon met again, in the tets beside: a table of
/// those found last, by a hash, leaves most of the repetitions out.
std::vector<SurfaceVertex> surface_vertices_of(const TetNodes& tets, const TetNeighbours& neighbours,
                                               const std::vector<MaterialId>& materials, std::size_t begin,
                                               std::size_t end) {
  constexpr std::size_t kRecent = 4096;
  std::vector<SurfaceVertex> found, recent(kRecent, {kNoVertex, kBackground});
  for (std::size_t t = begin; t < end; ++t) {
    for (std::size_t n = 0; n < 4 && materials[t] != kBackground; ++n) {
      const TetId across = neighbours[t][n];
      if (across != kNoTet && materials[across] == materials[t]) {
        continue;
      }
      for (const std::uint8_t corner : kTetFace[n]) {
        const SurfaceVertex vertex = {tets[t][corner], materials[t]};
        SurfaceVertex& last = recent[(vertex.vertex + 97U * vertex.material) % kRecent];
        if (last != vertex) {
          last = vertex;
          found.push_back(vertex);
        }
      }
    }
  }
  return found;
}

}  // namespace

std::vector<SurfaceVertex> surface_vertices(const TetNodes& tets, const TetNeighbours& neighbours,
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
  slices_.resize(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic, 1)
  for (int k = 0; k < size[2]; ++k) {
    Slice& slice = slices_[static_cast<std::size_t>(k)];
    for (int j = 0; j < size[1]; ++j) {
      slice.first.push_back(slice.i.size());
      rows.find(j, k, slice.i);
    }
    slice.first.push_back(slice.i.size());
    slice.i.shrink_to_fit();
  }
}

namespace {

/// Surface vertices sorted by cubes, so that one near a place is found without looking at the others.
class VertexCubes {
 public:
  VertexCubes(const ImageFrame& frame, const std::vector<SurfaceVertex>& surface,
              const std::vector<Vec3>& points, double distance_mm)
      // Finer cubes than a few voxels would cost memory and narrow the search little.
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

  struct Place {
    Vec3 at;
    MaterialId material;
  };

  /// True when a vertex of the material lies within the distance of x. `last` is the one found for the
  /// place before: along a row it mostly does for the next place too.
  [[nodiscard]] bool is_near(const Vec3& x, MaterialId material, const Place*& last) const {
    if (last != nullptr && reaches(*last, x, material)) {
      return true;
    }
    const Index3 own = cubes_.cube_of(x);
    if (is_near_in(cubes_.number(own), x, material, last)) {
      return true;
    }
    const Index3 low = cubes_.cube_of(x - Vec3{distance_mm_, distance_mm_, distance_mm_});
    const Index3 high = cubes_.cube_of(x + Vec3{distance_mm_, distance_mm_, distance_mm_});
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          if (Index3{i, j, k} != own && is_near_in(cubes_.number({i, j, k}), x, material, last)) {
            return true;
          }
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] bool reaches(const Place& place, const Vec3& x, MaterialId material) const {
    return place.material == material && (x - place.at).squared_norm() <= distance_mm_ * distance_mm_;
  }

  [[nodiscard]] bool is_near_in(std::size_t cube, const Vec3& x, MaterialId material,
                                const Place*& last) const {
    for (std::uint32_t p = first_[cube]; p < first_[cube + 1]; ++p) {
      if (reaches(places_[p], x, material)) {
        last = &places_[p];
        return true;
      }
    }
    return false;
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
  std::vector<std::vector<std::size_t>> uncovered(slices_.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < slices_.size(); ++k) {
    const Slice& slice = slices_[k];
    const VertexCubes::Place* last = nullptr;
    for (std::size_t j = 0; j + 1 < slice.first.size(); ++j) {
      const std::size_t row = image_.frame.offset(0, static_cast<int>(j), static_cast<int>(k));
      for (std::size_t b = slice.first[j]; b < slice.first[j + 1]; ++b) {
        const std::size_t voxel = row + static_cast<std::size_t>(slice.i[b]);
        const Vec3 centre = image_.frame.local_centre(slice.i[b], static_cast<int>(j), static_cast<int>(k));
        if (!cubes.is_near(centre, image_.voxels[voxel], last)) {
          uncovered[k].push_back(voxel);
        }
      }
    }
  }
  uncovered_.clear();
  uncovered_count_ = 0;
  for (const auto& of_slice : uncovered) {
    uncovered_count_ += of_slice.size();
    for (const std::size_t voxel : of_slice) {
      uncovered_.set(voxel);
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

InterfaceCoverage::InterfaceCoverage(const ImageDomain& domain)
    : image_(domain.image()), samples_(domain.samples()), wanted_(image_.frame.voxel_count()) {}

void InterfaceCoverage::update(const std::vector<MaterialSet>& sets, const std::vector<Vec3>& points,
                               double distance_mm) {
  wanted_.clear();
  const std::vector<std::size_t> uncovered =
      renew_covering_vertices(samples_, points, sets, distance_mm, covering_);
  uncovered_ = uncovered.size();
  for (const std::size_t s : uncovered) {
    want(samples_[s]);
  }
}

void InterfaceCoverage::want(const BoundarySample& sample) {
  const ImageFrame& frame = image_.frame;
  Index3 at;
  for (int axis = 0; axis < 3; ++axis) {
    at[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::lround(sample.centre()[axis] / frame.spacing_mm[axis]));
  }
  wanted_.set(frame.offset(at[0], at[1], at[2]));
  for (std::size_t n = 0; n < 6; ++n) {
    Index3 across = at;
    across[n / 2] += n % 2 == 0 ? -1 : 1;
    if (frame.contains(across[0], across[1], across[2]) &&
        image_.at(across[0], across[1], across[2]) == sample.other) {
      wanted_.set(frame.offset(across[0], across[1], across[2]));
    }
  }
}

}  // namespace cbc3d
