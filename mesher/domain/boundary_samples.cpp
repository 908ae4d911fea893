#include "mesher/domain/boundary_samples.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/parallel.hpp"
#include "mesher/domain/cubes.hpp"

namespace cbc3d {
namespace {

/// Calls f(other) for each distinct other material across a face of voxel (i,j,k).
template <typename F>
void for_each_other(const LabelImage& image, int i, int j, int k, MaterialId own, const F& f) {
  constexpr std::array<Index3, 6> kSteps = {
      {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  std::array<MaterialId, 6> seen{};
  std::size_t count = 0;
  for (const Index3& s : kSteps) {
    const MaterialId m = image.at_or_background(i + s[0], j + s[1], k + s[2]);
    if (m != own && std::find(seen.begin(), seen.begin() + count, m) == seen.begin() + count) {
      seen[count++] = m;
      f(m);
    }
  }
}

/// The vertices on interfaces, sorted by the cube they lie in; cubes are as long as the reach.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets, double cell_mm)
      : cubes_{cell_mm} {
    const std::vector<VertexId> chosen =
        indices_where(vertices.size(), [&](std::size_t v) { return sets[v].size > 1; });
    entries_.resize(chosen.size());
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      entries_[i] = {CubeKeys::key(cubes_.cube_of(vertices[chosen[i]])), chosen[i]};
    }
    sort_distinct(entries_);
  }

  /// Calls f(vertex) for the vertices of the 27 cubes around x until it returns true.
  template <typename F>
  void near(const Vec3& x, const F& f) const {
    const Index3 c = cubes_.cube_of(x);
    for (int k = c[2] - 1; k <= c[2] + 1; ++k) {
      for (int j = c[1] - 1; j <= c[1] + 1; ++j) {  // three cubes along x follow each other
        const Entry low = {CubeKeys::key({c[0] - 1, j, k}), 0};
        const std::uint64_t high = CubeKeys::key({c[0] + 1, j, k});
        for (auto e = std::lower_bound(entries_.begin(), entries_.end(), low);
             e != entries_.end() && e->key <= high; ++e) {
          if (f(e->vertex)) {
            return;
          }
        }
      }
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    VertexId vertex;
    auto operator<=>(const Entry&) const = default;
  };
  CubeKeys cubes_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<BoundarySample> boundary_samples(const LabelImage& image) {
  const Index3& size = image.frame.size;
  std::vector<std::vector<BoundarySample>> slices(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    auto& slice = slices[static_cast<std::size_t>(k)];
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const MaterialId own = image.at(i, j, k);
        if (own == kBackground) {
          continue;
        }
        for_each_other(image, i, j, k, own, [&](MaterialId other) {
          const Vec3 c = image.frame.local_centre(i, j, k);
          slice.push_back(
              {{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)}, own, other});
        });
      }
    }
  }
  std::vector<BoundarySample> samples;
  for (const auto& slice : slices) {
    samples.insert(samples.end(), slice.begin(), slice.end());
  }
  return samples;
}

std::vector<VertexId> nearest_covering_vertices(const std::vector<BoundarySample>& samples,
                                                const std::vector<Vec3>& vertices,
                                                const std::vector<MaterialSet>& sets, double reach_mm) {
  const VertexGrid grid(vertices, sets, reach_mm);
  std::vector<VertexId> covering(samples.size(), kNoVertex);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t s = 0; s < samples.size(); ++s) {
    double nearest = reach_mm * reach_mm;
    grid.near(samples[s].centre(), [&](VertexId v) {
      const double d = (vertices[v] - samples[s].centre()).squared_norm();
      if (d <= nearest && samples[s].is_on(sets[v])) {
        nearest = d;
        covering[s] = v;
      }
      return false;
    });
  }
  return covering;
}

std::vector<std::size_t> renew_covering_vertices(const std::vector<BoundarySample>& samples,
                                                 const std::vector<Vec3>& vertices,
                                                 const std::vector<MaterialSet>& sets, double reach_mm,
                                                 std::vector<VertexId>& covering) {
  covering.resize(samples.size(), kNoVertex);
  const std::vector<std::uint32_t> doubtful = indices_where(samples.size(), [&](std::size_t s) {
    return covering[s] == kNoVertex || !samples[s].is_on(sets[covering[s]]);
  });
  std::vector<std::size_t> uncovered(doubtful.begin(), doubtful.end());
  if (uncovered.empty()) {
    return uncovered;
  }
  const VertexGrid grid(vertices, sets, reach_mm);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t i = 0; i < uncovered.size(); ++i) {
    const BoundarySample& sample = samples[uncovered[i]];
    VertexId& found = covering[uncovered[i]];
    found = kNoVertex;
    grid.near(sample.centre(), [&](VertexId v) {
      if ((vertices[v] - sample.centre()).squared_norm() <= reach_mm * reach_mm && sample.is_on(sets[v])) {
        found = v;
      }
      return found != kNoVertex;
    });
  }
  std::erase_if(uncovered, [&](std::size_t s) { return covering[s] != kNoVertex; });
  return uncovered;
}

std::vector<std::size_t> uncovered_samples(const std::vector<BoundarySample>& samples,
                                           const std::vector<Vec3>& vertices,
                                           const std::vector<MaterialSet>& sets, double reach_mm) {
  std::vector<VertexId> covering;
  return renew_covering_vertices(samples, vertices, sets, reach_mm, covering);
}

}  // namespace cbc3d
