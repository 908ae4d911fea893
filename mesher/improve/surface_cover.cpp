#include "mesher/improve/surface_cover.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {
namespace {

/// Calls f(material) for each boundary that voxel (i,j,k) is on.
template <typename F>
void for_each_boundary_of(const LabelImage& image, int i, int j, int k, const F& f) {
  const MaterialId own = image.at(i, j, k);
  if (own == kBackground) {
    return;
  }
  bool other = false;
  bool background = false;
  constexpr std::array<Index3, 6> kSteps = {
      {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};
  for (const Index3& s : kSteps) {
    const MaterialId m = image.at_or_background(i + s[0], j + s[1], k + s[2]);
    other = other || m != own;
    background = background || m == kBackground;
  }
  if (other) {
    f(own);
  }
  if (background) {
    f(kBackground);
  }
}

/// Surface vertices in cubes as long as the reach, sorted by cube.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets, double cell_mm)
      : vertices_(vertices), cell_mm_(cell_mm) {
    for (VertexId v = 0; v < vertices.size(); ++v) {
      if (sets[v].size > 1) {
        entries_.push_back({key(cell_of(vertices[v])), v});
      }
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /// Calls f(vertex) for the vertices of the 27 cubes round x.
  template <typename F>
  void near(const Vec3& x, const F& f) const {
    const Index3 c = cell_of(x);
    for (int k = c[2] - 1; k <= c[2] + 1; ++k) {
      for (int j = c[1] - 1; j <= c[1] + 1; ++j) {  // three cubes along x follow each other
        const Entry low = {key({c[0] - 1, j, k}), 0};
        const std::uint64_t high = key({c[0] + 1, j, k});
        for (auto e = std::lower_bound(entries_.begin(), entries_.end(), low);
             e != entries_.end() && e->key <= high; ++e) {
          f(e->vertex);
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
  [[nodiscard]] Index3 cell_of(const Vec3& x) const {
    return {static_cast<int>(std::floor(x.x / cell_mm_)), static_cast<int>(std::floor(x.y / cell_mm_)),
            static_cast<int>(std::floor(x.z / cell_mm_))};
  }
  static std::uint64_t key(const Index3& c) {
    constexpr int kShift = 1 << 20;  // cubes may have negative indices
    return (static_cast<std::uint64_t>(c[2] + kShift) << 42) |
           (static_cast<std::uint64_t>(c[1] + kShift) << 21) | static_cast<std::uint64_t>(c[0] + kShift);
  }

  const std::vector<Vec3>& vertices_;
  double cell_mm_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<CoverPoint> boundary_points(const LabelImage& image) {
  const Index3& size = image.frame.size;
  std::vector<std::vector<CoverPoint>> slices(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    auto& slice = slices[static_cast<std::size_t>(k)];
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        for_each_boundary_of(image, i, j, k, [&](MaterialId material) {
          const Vec3 c = image.frame.local_centre(i, j, k);
          slice.push_back(
              {{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)}, material});
        });
      }
    }
  }
  std::vector<CoverPoint> points;
  for (const auto& slice : slices) {
    points.insert(points.end(), slice.begin(), slice.end());
  }
  return points;
}

void SurfaceCover::add(VertexId host, PointId point) {
  links_.push_back({point, first_[host]});
  first_[host] = static_cast<PointId>(links_.size() - 1);
}

bool SurfaceCover::can_release(VertexId v, const Vec3* to, std::span<const VertexId> others,
                               const TetComplex& mesh, const std::vector<MaterialSet>& sets) {
  new_hosts_.clear();
  for (PointId link = first_[v]; link != kNoPoint; link = links_[link].next) {
    const PointId point = links_[link].point;
    if (to != nullptr && reaches(*to, point)) {
      new_hosts_.push_back(kNoVertex);
      continue;
    }
    const MaterialId material = (*points_)[point].material;
    const auto host = std::find_if(others.begin(), others.end(), [&](VertexId w) {
      return sets[w].size > 1 && sets[w].has(material) && reaches(mesh.point(w), point);
    });
    if (host == others.end()) {
      return false;
    }
    new_hosts_.push_back(*host);
  }
  return true;
}

void SurfaceCover::commit(VertexId v) {
  PointId link = first_[v];
  first_[v] = kNoPoint;
  for (const VertexId host : new_hosts_) {
    const PointId next = links_[link].next;
    PointId& first = first_[host == kNoVertex ? v : host];
    links_[link].next = first;
    first = link;
    link = next;
  }
}

std::vector<VertexId> nearest_hosts(const std::vector<CoverPoint>& points, const std::vector<Vec3>& vertices,
                                    const std::vector<MaterialSet>& sets, double reach_mm) {
  const VertexGrid grid(vertices, sets, reach_mm);
  std::vector<VertexId> hosts(points.size(), kNoVertex);
#pragma omp parallel for schedule(static, 1024)
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto& c = points[p].centre_mm;
    const Vec3 centre = {c[0], c[1], c[2]};
    double nearest = reach_mm * reach_mm;
    grid.near(centre, [&](VertexId v) {
      const double d = (vertices[v] - centre).squared_norm();
      if (d <= nearest && sets[v].has(points[p].material)) {
        nearest = d;
        hosts[p] = v;
      }
    });
  }
  return hosts;
}

}  // namespace cbc3d
