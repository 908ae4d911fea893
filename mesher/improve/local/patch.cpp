#include "mesher/improve/local/patch.hpp"

#include <algorithm>

namespace cbc3d {

double Patch::facet_deviation(const Vec3& p, const Vec3& q, const Vec3& r, MaterialId inner,
                              MaterialId outer) const {
  double largest = boundaries.distance((p + q + r) / 3, inner, outer).deviation_mm;
  for (const Vec3& middle : {0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p)}) {
    largest = std::max(largest, boundaries.distance(middle, inner, outer).deviation_mm);
  }
  return largest;
}

double Patch::facet_cosine(const Vec3& p, const Vec3& q, const Vec3& r, MaterialId inner,
                           MaterialId outer) const {
  const BoundaryDistance at = boundaries.distance((p + q + r) / 3, inner, outer);
  const Vec3 normal = (q - p).cross(r - p);
  const double area = normal.norm();
  return at.is_close && area > 0 ? -normal.dot(at.normal) / area : 1;
}

void Patch::renew_sets(std::span<const FreshTet> fresh_tets) {
  around_other.clear();
  // A vertex within one material stays there while the tets put in are of it.
  const MaterialId first = fresh_tets.empty() ? kBackground : fresh_tets.front().material;
  const bool uniform = std::all_of(fresh_tets.begin(), fresh_tets.end(),
                                   [&](const FreshTet& tet) { return tet.material == first; });
  const auto is_within = [&](VertexId v) { return uniform && sets[v].size == 1 && sets[v].ids[0] == first; };
  for (const FreshTet& tet : fresh_tets) {
    for (const VertexId v : tet.nodes) {
      if (!mesh.locked(v) && !is_within(v) &&
          std::find(around_other.begin(), around_other.end(), v) == around_other.end()) {
        around_other.push_back(v);
      }
    }
  }
  renew_sets_of(around_other);
}

void Patch::renew_sets_of(std::span<const VertexId> vertices) {
  for (const VertexId v : vertices) {
    if (!mesh.locked(v) && mesh.in_use(v)) {
      mesh.star(v, star_other);
      sets[v] = mesh.materials(v, star_other);
    }
  }
}

}  // namespace cbc3d
