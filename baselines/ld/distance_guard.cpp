#include "baselines/ld/distance_guard.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/core/nearest_on_triangle.hpp"

namespace cbc3d::baselines::ld {
namespace {

double squared_distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  return (nearest_on_triangle(p, t[0], t[1], t[2]).at - p).squared_norm();
}

LatticePoint middle(const LatticePoint& a, const LatticePoint& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// The four triangles that the middles of the edges cut a triangle into.
template <typename Point, typename Middle>
std::array<std::array<Point, 3>, 4> quarters(const std::array<Point, 3>& t, const Middle& mid) {
  const Point a = mid(t[1], t[2]);
  const Point b = mid(t[2], t[0]);
  const Point c = mid(t[0], t[1]);
  return {{{t[0], c, b}, {c, t[1], a}, {b, a, t[2]}, {a, b, c}}};
}

/// Bounds are kept by more than rounding can take.
double guarded_square(double bound_mm) {
  return bound_mm * bound_mm * (1 - 1e-9);
}

}  // namespace

DistanceGuard::DistanceGuard(const CellGrid& grid, MergeMesh& mesh, const SurfaceDistanceBounds& bounds)
    : grid_(grid),
      mesh_(mesh),
      squared_image_to_mesh_(guarded_square(bounds.image_to_mesh_mm)),
      squared_mesh_to_image_(guarded_square(bounds.mesh_to_image_mm)),
      half_mm_(grid.cell_mm() * 0.5),
      first_(mesh.vertex_count(), kEnd),
      next_(mesh.pieces().size(), kEnd) {
  for (std::size_t piece = next_.size(); piece-- > 0;) {
    std::uint32_t& first = first_[mesh.pieces()[piece].facet[0]];
    next_[piece] = first;
    first = static_cast<std::uint32_t>(piece);
  }
  list_near_faces();
}

// All faces that a place in cell (0,0,0) can have within the bound.
void DistanceGuard::list_near_faces() {
  const Vec3 cell = grid_.cell_mm();
  const double reach = std::sqrt(squared_mesh_to_image_);
  Index3 cells{};
  for (int a = 0; a < 3; ++a)
    cells[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(reach / cell[a])) + 2;
  std::vector<std::pair<double, NearFace>> faces;
  for (int k = -cells[2]; k <= cells[2]; ++k) {
    for (int j = -cells[1]; j <= cells[1]; ++j) {
      for (int i = -cells[0]; i <= cells[0]; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
          Vec3 centre{i * cell.x, j * cell.y, k * cell.z};
          centre[axis] += 0.5 * cell[axis];
          if (centre.norm() <= reach + cell.norm())
            faces.push_back({centre.squared_norm(), {{i, j, k}, axis}});
        }
      }
    }
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [distance, face] : faces) near_faces_.push_back(face);
}

void DistanceGuard::gather(VertexId v, const Fan& fan) {
  v_ = v;
  fan_ = fan.facets();
  owners_ = fan.vertices();
  owners_.push_back(v);
  old_.clear();
  for (const VertexId owner : owners_) {
    for (std::uint32_t p = first_[owner]; p != kEnd; p = next_[p]) {
      const auto& facet = mesh_.pieces()[p].facet;
      const auto at = std::find(facet.begin(), facet.end(), v);
      if (at == facet.end()) continue;
      const auto n = static_cast<std::size_t>(at - facet.begin());
      const auto [x, y] = std::minmax(facet[(n + 1) % 3], facet[(n + 2) % 3]);
      const auto own = std::find_if(fan_.begin(), fan_.end(), [&, low = x, high = y](const FanFacet& f) {
        return f.x == low && f.y == high;
      });
      old_.push_back({p, own->low, own->high});
    }
  }
}

bool DistanceGuard::accepts(VertexId w) {
  assignments_.clear();
  if (!set_new_facets(w)) return false;
  for (const OldPiece& old : old_) {
    const std::size_t before = assignments_.size();
    if (!assign(old, mesh_.pieces()[old.piece].corners, 0, w)) return false;
    assignments_[before].is_first = true;
  }
  return true;
}

bool DistanceGuard::set_new_facets(VertexId w) {
  new_facets_.clear();
  for (const FanFacet& f : fan_) {
    if (f.x == w || f.y == w) continue;
    const Triangle corners{mm_of(mesh_.point(w)), mm_of(mesh_.point(f.x)), mm_of(mesh_.point(f.y))};
    new_facets_.push_back({f, corners});
  }
  return std::all_of(new_facets_.begin(), new_facets_.end(),
                     [&](const NewFacet& f) { return is_near_image(f.corners, f.facet, 0); });
}

/// Squared distance of a place from the face of cell `c` towards the next cell along `axis`.
double DistanceGuard::squared_distance_from_face(const Vec3& p, const Index3& c, int axis) const {
  const Vec3 cell = grid_.cell_mm();
  double sum = 0;
  for (int a = 0; a < 3; ++a) {
    const int n = c[static_cast<std::size_t>(a)];
    const double from = (a == axis ? n + 1 : n) * cell[a];
    const double to = (n + 1) * cell[a];
    const double off = std::fmax(0.0, std::fmax(from - p[a], p[a] - to));
    sum += off * off;
  }
  return sum;
}

bool DistanceGuard::is_near_image(const Triangle& t, const FanFacet& facet, int depth) const {
  constexpr int kMostCuts = 6;
  const Vec3 centre = (t[0] + t[1] + t[2]) / 3;
  const Vec3 cell = grid_.cell_mm();
  Index3 home{};
  for (int a = 0; a < 3; ++a)
    home[static_cast<std::size_t>(a)] = static_cast<int>(std::floor(centre[a] / cell[a]));
  bool is_centre_near = false;
  for (const NearFace& near : near_faces_) {
    const Index3 c{home[0] + near.cell[0], home[1] + near.cell[1], home[2] + near.cell[2]};
    Index3 next = c;
    ++next[static_cast<std::size_t>(near.axis)];
    const auto [low, high] = std::minmax({grid_.at(c[0], c[1], c[2]), grid_.at(next[0], next[1], next[2])});
    if (low != facet.low || high != facet.high) continue;
    const auto is_near = [&](const Vec3& p) {
      return squared_distance_from_face(p, c, near.axis) <= squared_mesh_to_image_;
    };
    if (std::all_of(t.begin(), t.end(), is_near)) return true;
    is_centre_near = is_centre_near || is_near(centre);
  }
  if (!is_centre_near || depth == kMostCuts) return false;
  const auto parts = quarters(t, [](const Vec3& a, const Vec3& b) { return (a + b) * 0.5; });
  return std::all_of(parts.begin(), parts.end(),
                     [&](const Triangle& part) { return is_near_image(part, facet, depth + 1); });
}

bool DistanceGuard::assign(const OldPiece& old, const std::array<LatticePoint, 3>& corners, int depth,
                           VertexId w) {
  constexpr int kMostCuts = 2;
  std::array<Vec3, 3> p;
  for (std::size_t n = 0; n < 3; ++n) p[n] = mm_of(corners[n]) / BoundaryPiece::kUnitsPerHalfCell;
  for (const NewFacet& f : new_facets_) {
    if (f.facet.low != old.low || f.facet.high != old.high) continue;
    const bool is_near = std::all_of(p.begin(), p.end(), [&](const Vec3& corner) {
      return squared_distance(corner, f.corners) <= squared_image_to_mesh_;
    });
    if (is_near) {
      assignments_.push_back({old.piece, corners, {f.facet.x, f.facet.y, w}, false});
      return true;
    }
  }
  const bool is_even = std::all_of(corners.begin(), corners.end(), [&](const LatticePoint& c) {
    return (c[0] - corners[0][0]) % 2 == 0 && (c[1] - corners[0][1]) % 2 == 0 &&
           (c[2] - corners[0][2]) % 2 == 0;
  });
  if (depth == kMostCuts || !is_even) return false;
  const auto parts = quarters(corners, middle);
  return std::all_of(parts.begin(), parts.end(), [&](const std::array<LatticePoint, 3>& part) {
    return assign(old, part, depth + 1, w);
  });
}

void DistanceGuard::merge() {
  auto& pieces = mesh_.pieces();
  for (const VertexId owner : owners_) {
    std::uint32_t* link = &first_[owner];
    while (*link != kEnd) {
      const auto& facet = pieces[*link].facet;
      const bool is_old = facet[0] == v_ || facet[1] == v_ || facet[2] == v_;
      if (is_old) {
        *link = next_[*link];
      } else {
        link = &next_[*link];
      }
    }
  }
  for (const Assignment& a : assignments_) {
    std::uint32_t p = a.piece;
    if (!a.is_first) {
      p = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
      next_.push_back(kEnd);
    }
    pieces[p] = {a.corners, a.facet};
    next_[p] = first_[a.facet[0]];
    first_[a.facet[0]] = p;
  }
}

}  // namespace cbc3d::baselines::ld
