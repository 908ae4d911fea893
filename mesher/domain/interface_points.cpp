#include "mesher/domain/interface_points.hpp"

#include <omp.h>

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

/// Vertices on interfaces in cubes as long as the reach, sorted by cube.
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

  /// Calls f(vertex) for the vertices of the 27 cubes round x until it returns true.
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

void MaterialSet::add(MaterialId material) {
  if (size == 1 && ids[0] == material) {  // most often
    return;
  }
  const auto end = ids.begin() + size;
  const auto at = std::lower_bound(ids.begin(), end, material);
  if (at != end && *at == material) {
    return;
  }
  if (size == kCapacity) {
    overflow = true;
    return;
  }
  std::move_backward(at, end, end + 1);
  *at = material;
  ++size;
}

std::vector<MaterialSet> vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                                          const TetNeighbours& neighbours, std::size_t vertex_count) {
  std::vector<MaterialSet> sets(vertex_count);
  renew_vertex_materials(tets, materials, neighbours, std::vector<std::uint8_t>(vertex_count, 1), sets);
  return sets;
}

void renew_vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                            const TetNeighbours& neighbours, const std::vector<std::uint8_t>& touched,
                            std::vector<MaterialSet>& sets) {
  const std::vector<std::uint32_t> concerned = indices_where(tets.size(), [&](std::size_t t) {
    const auto& n = tets[t];
    return (touched[n[0]] | touched[n[1]] | touched[n[2]] | touched[n[3]]) != 0;
  });
  const auto parts = static_cast<std::size_t>(std::min(8, omp_get_max_threads()));
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    // Every thread passes over all these tets for its range of vertices, so that a set sees them in order.
    const auto begin = static_cast<VertexId>(part * sets.size() / parts);
    const auto end = static_cast<VertexId>((part + 1) * sets.size() / parts);
    const auto is_mine = [&](VertexId v) { return v >= begin && v < end && touched[v] != 0; };
    for (VertexId v = begin; v < end; ++v) {
      sets[v] = touched[v] != 0 ? MaterialSet{} : sets[v];
    }
    for (const std::uint32_t t : concerned) {
      for (std::size_t n = 0; n < 4; ++n) {
        if (is_mine(tets[t][n])) {
          sets[tets[t][n]].add(materials[t]);
        }
        if (neighbours[t][n] == kNoTet && materials[t] != kBackground) {
          for (const std::uint8_t face : kTetFace[n]) {
            if (is_mine(tets[t][face])) {
              sets[tets[t][face]].add(kBackground);
            }
          }
        }
      }
    }
  }
}

bool all_meet_near(const LabelImage& image, const Vec3& local_mm, const MaterialSet& set, double reach_mm) {
  const ImageFrame& frame = image.frame;
  Index3 low;
  Index3 high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    // Of needle or plate voxels no more than a few: hundreds lie within reach along their short side.
    const double reach = std::min(reach_mm / frame.spacing_mm[axis], 4.0);
    low[a] = static_cast<int>(std::floor(local_mm[axis] / frame.spacing_mm[axis] - reach));
    high[a] = static_cast<int>(std::floor(local_mm[axis] / frame.spacing_mm[axis] + reach));
  }
  std::array<std::uint8_t, MaterialSet::kCapacity> met{};  // bits of the materials that each has met
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        unsigned here = 0;
        for (int c = 0; c < 8; ++c) {
          const MaterialId m = image.at_or_background(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          for (std::uint8_t s = 0; s < set.size; ++s) {
            here |= set.ids[s] == m ? 1U << s : 0U;
          }
        }
        for (std::uint8_t s = 0; s < set.size; ++s) {
          met[s] = static_cast<std::uint8_t>(met[s] | ((here >> s & 1U) != 0 ? here : 0U));
        }
      }
    }
  }
  const auto all = static_cast<std::uint8_t>((1U << set.size) - 1U);
  return std::all_of(met.begin(), met.begin() + set.size, [all](std::uint8_t m) { return m == all; });
}

std::vector<InterfacePoint> interface_points(const LabelImage& image) {
  const Index3& size = image.frame.size;
  std::vector<std::vector<InterfacePoint>> slices(static_cast<std::size_t>(size[2]));
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
  std::vector<InterfacePoint> points;
  for (const auto& slice : slices) {
    points.insert(points.end(), slice.begin(), slice.end());
  }
  return points;
}

std::vector<VertexId> nearest_hosts(const std::vector<InterfacePoint>& points,
                                    const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets,
                                    double reach_mm) {
  const VertexGrid grid(vertices, sets, reach_mm);
  std::vector<VertexId> hosts(points.size(), kNoVertex);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t p = 0; p < points.size(); ++p) {
    double nearest = reach_mm * reach_mm;
    grid.near(points[p].centre(), [&](VertexId v) {
      const double d = (vertices[v] - points[p].centre()).squared_norm();
      if (d <= nearest && points[p].is_on(sets[v])) {
        nearest = d;
        hosts[p] = v;
      }
      return false;
    });
  }
  return hosts;
}

std::vector<std::size_t> renew_hosts(const std::vector<InterfacePoint>& points,
                                     const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets,
                                     double reach_mm, std::vector<VertexId>& hosts) {
  hosts.resize(points.size(), kNoVertex);
  const std::vector<std::uint32_t> lost = indices_where(points.size(), [&](std::size_t p) {
    return hosts[p] == kNoVertex || !points[p].is_on(sets[hosts[p]]);
  });
  std::vector<std::size_t> without(lost.begin(), lost.end());
  if (without.empty()) {
    return without;
  }
  const VertexGrid grid(vertices, sets, reach_mm);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t i = 0; i < without.size(); ++i) {
    const InterfacePoint& point = points[without[i]];
    VertexId& host = hosts[without[i]];
    host = kNoVertex;
    grid.near(point.centre(), [&](VertexId v) {
      if ((vertices[v] - point.centre()).squared_norm() <= reach_mm * reach_mm && point.is_on(sets[v])) {
        host = v;
      }
      return host != kNoVertex;
    });
  }
  std::erase_if(without, [&](std::size_t p) { return hosts[p] != kNoVertex; });
  return without;
}

std::vector<std::size_t> points_without_host(const std::vector<InterfacePoint>& points,
                                             const std::vector<Vec3>& vertices,
                                             const std::vector<MaterialSet>& sets, double reach_mm) {
  std::vector<VertexId> hosts;
  return renew_hosts(points, vertices, sets, reach_mm, hosts);
}

}  // namespace cbc3d
