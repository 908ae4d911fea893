#include "mesher/improve/surface/surface_defects.hpp"

#include <limits>

#include "mesher/improve/surface/self_intersections.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFarthest = 2;  // in units of the limit: what is farther counts as this
constexpr double kReach = 2;     // likewise: no step takes a vertex from beyond this to within the limit

struct Box {
  Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  void grow(double by) {
    low -= Vec3{by, by, by};
    high += Vec3{by, by, by};
  }
};

bool boxes_meet(const Vec3& low, const Vec3& high, const Vec3& other_low, const Vec3& other_high) {
  return low.x <= other_high.x && other_low.x <= high.x && low.y <= other_high.y && other_low.y <= high.y &&
         low.z <= other_high.z && other_low.z <= high.z;
}

bool has(const std::vector<VertexId>& sorted, VertexId v) {
  return std::binary_search(sorted.begin(), sorted.end(), v);
}

}  // namespace

bool SurfaceDefects::is_better_than(const SurfaceDefects& other, bool may_trade) const {
  constexpr double kTiny = 1e-3;
  const bool shape_no_worse =
      may_trade ? shape() <= other.shape() : pinches <= other.pinches && cuts <= other.cuts;
  const bool no_worse = shape_no_worse && far <= other.far && lonely <= other.lonely;
  return no_worse && (shape() < other.shape() || far < other.far - kTiny || lonely < other.lonely - kTiny ||
                      folds < other.folds);
}

std::vector<VertexId> ring_of(const LabelledComplex& complex, const std::vector<VertexId>& vertices) {
  std::vector<VertexId> ring;
  for (const VertexId v : vertices) {
    for (const TetId t : complex.star(v)) {
      const auto& nodes = complex.mesh().tets[t];
      ring.insert(ring.end(), nodes.begin(), nodes.end());
    }
  }
  std::sort(ring.begin(), ring.end());
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  return ring;
}

void FaultMeter::make_grids() {
  vertex_grid_ = PlaceGrid(2 * guide_.limit_mm);
  for (VertexId v = 0; v < complex_.mesh().points.size(); ++v) {
    if (!complex_.star(v).empty()) {
      vertex_grid_.add(complex_.mesh().points[v], v);
    }
  }
  vertex_grid_.sort();
  point_grid_ = PlaceGrid(2 * guide_.limit_mm);
  for (std::uint32_t p = 0; p < guide_.points.size(); ++p) {
    point_grid_.add(guide_.points[p].centre(), p);
  }
  point_grid_.sort();
  has_grids_ = true;
}

void FaultMeter::look_at(std::span<const VertexId> vertices) {
  if (!has_grids_) {
    make_grids();
  }
  Box box;
  for (const VertexId v : vertices) {
    box.add(complex_.mesh().points[v]);
  }
  points_.clear();
  box.grow(2 * guide_.limit_mm);
  point_grid_.for_each_near(box.low, box.high, [&](std::uint32_t p) { points_.push_back(p); });
  std::sort(points_.begin(), points_.end());
  std::vector<VertexId> near;
  box.grow(guide_.limit_mm);
  vertex_grid_.for_each_near(box.low, box.high, [&](VertexId v) { near.push_back(v); });
  std::sort(near.begin(), near.end());
  list_vertices_near_points(near);
  list_facets_near(near);
}

void FaultMeter::list_vertices_near_points(const std::vector<VertexId>& vertices) {
  const double reach_squared = kReach * kReach * guide_.limit_mm * guide_.limit_mm;
  first_near_.assign(1, 0);
  near_.clear();
  for (const std::uint32_t p : points_) {
    const Vec3 at = guide_.points[p].centre();
    for (const VertexId v : vertices) {
      if ((complex_.mesh().points[v] - at).squared_norm() <= reach_squared) {
        near_.push_back(v);
      }
    }
    first_near_.push_back(static_cast<std::uint32_t>(near_.size()));
  }
}

void FaultMeter::list_facets_near(const std::vector<VertexId>& vertices) {
  std::vector<TetId> tets;
  for (const VertexId v : vertices) {
    if (complex_.set(v).has(kBackground)) {
      tets.insert(tets.end(), complex_.star(v).begin(), complex_.star(v).end());
    }
  }
  facets_.clear();
  add_facets(tets, facets_);
}

void FaultMeter::add_facets(std::vector<TetId>& tets, std::vector<Facet>& facets) const {
  std::sort(tets.begin(), tets.end());
  tets.erase(std::unique(tets.begin(), tets.end()), tets.end());
  for (const TetId t : tets) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (complex_.is_facet(t, n)) {
        facets.push_back(facet(t, n));
      }
    }
  }
}

FaultMeter::Scope FaultMeter::scope_of(std::vector<VertexId> vertices) const {
  Scope scope;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const double reach_squared = kReach * kReach * guide_.limit_mm * guide_.limit_mm;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Vec3 at = guide_.points[points_[i]].centre();
    if (std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) {
          return (complex_.mesh().points[v] - at).squared_norm() <= reach_squared;
        })) {
      scope.points.push_back(i);
    }
  }
  scope.vertices = std::move(vertices);
  return scope;
}

SurfaceDefects FaultMeter::measure(const Scope& scope, std::size_t most) const {
  SurfaceDefects faults;
  faults.pinches = pinches(scope.vertices);
  if (faults.pinches <= most) {
    count_cuts_and_folds(scope.vertices, faults);
    faults.far = far(scope.vertices);
    faults.lonely = lonely(scope);
  }
  return faults;
}

std::size_t FaultMeter::pinches(const std::vector<VertexId>& vertices) const {
  std::size_t sum = 0;
  for (const VertexId v : vertices) {
    const MaterialSet& set = complex_.set(v);
    sum += set.overflow ? 1 : 0;
    for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
      sum += set.ids[i] != kBackground && !complex_.is_manifold_at(v, set.ids[i]) ? 1 : 0;
    }
  }
  return sum;
}

double FaultMeter::far(const std::vector<VertexId>& vertices) const {
  double sum = 0;
  for (const VertexId v : vertices) {
    const MaterialSet& set = complex_.set(v);
    const Vec3& at = complex_.mesh().points[v];
    for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
      if (!guide_.places.is_near(at, set.ids[i])) {
        const auto nearest = guide_.places.nearest(at, set.ids[i]);
        sum += nearest ? (*nearest - at).norm() / guide_.limit_mm : kFarthest;
      }
    }
  }
  return sum;
}

FaultMeter::Facet FaultMeter::facet(TetId t, std::size_t n) const {
  Facet facet{};
  facet.is_outer = complex_.across(t, n) == kBackground;
  facet.behind = complex_.mesh().tets[t][n];
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    facet.nodes[i] = complex_.mesh().tets[t][kTetFace[n][i]];
    box.add(complex_.mesh().points[facet.nodes[i]]);
  }
  box.grow(1e-6 * guide_.limit_mm);
  facet.low = box.low;
  facet.high = box.high;
  return facet;
}

void FaultMeter::count_cuts_and_folds(const std::vector<VertexId>& vertices, SurfaceDefects& faults) const {
  const auto is_active = [&](const Facet& f) {
    return has(vertices, f.nodes[0]) || has(vertices, f.nodes[1]) || has(vertices, f.nodes[2]);
  };
  std::vector<TetId> tets;
  for (const VertexId v : vertices) {
    tets.insert(tets.end(), complex_.star(v).begin(), complex_.star(v).end());
  }
  std::vector<Facet> facets;
  add_facets(tets, facets);
  std::erase_if(facets, [&](const Facet& f) { return !is_active(f); });
  const std::size_t active = facets.size();
  Box box;
  for (const Facet& f : facets) {
    box.add(f.low);
    box.add(f.high);
  }
  std::copy_if(facets_.begin(), facets_.end(), std::back_inserter(facets),
               [&](const Facet& f) { return boxes_meet(f.low, f.high, box.low, box.high) && !is_active(f); });
  const std::vector<Vec3>& points = complex_.mesh().points;
  for (std::size_t i = 0; i < active; ++i) {
    const Facet& f = facets[i];
    for (std::size_t j = i + 1; j < facets.size(); ++j) {
      const Facet& g = facets[j];
      if (boxes_meet(f.low, f.high, g.low, g.high)) {
        faults.cuts += facets_cross(points, f.nodes, g.nodes) ? 1 : 0;
        const bool may_fold = f.is_outer && g.is_outer;
        faults.folds += may_fold && facets_fold(points, f.nodes, f.behind, g.nodes, g.behind) ? 1 : 0;
      }
    }
  }
}

bool FaultMeter::is_on(VertexId v, std::uint32_t point, bool outer) const {
  const MaterialSet& set = complex_.set(v);
  if (set.size < 2 || outer) {
    return set.size > 1 && set.has(kBackground);
  }
  const MaterialId label = guide_.places.label_of[guide_.points[point].own];
  return std::any_of(set.ids.begin(), set.ids.begin() + set.size,
                     [&](MaterialId m) { return guide_.places.label_of[m] == label; });
}

double FaultMeter::distance_mm(std::uint32_t i, bool outer, VertexId& nearest) const {
  const Vec3 at = point(i).centre();
  double least = kInfinity;
  for (std::uint32_t n = first_near_[i]; n < first_near_[i + 1]; ++n) {
    const double squared = (complex_.mesh().points[near_[n]] - at).squared_norm();
    if (squared < least && is_on(near_[n], points_[i], outer)) {
      least = squared;
      nearest = near_[n];
    }
  }
  return std::sqrt(least);
}

bool FaultMeter::is_reached(std::uint32_t i, bool outer) const {
  const Vec3 at = point(i).centre();
  return std::any_of(near_.begin() + first_near_[i], near_.begin() + first_near_[i + 1], [&](VertexId v) {
    return (complex_.mesh().points[v] - at).squared_norm() <= guide_.limit_mm * guide_.limit_mm &&
           is_on(v, points_[i], outer);
  });
}

double FaultMeter::lonely(const Scope& scope) const {
  double sum = 0;
  for (const std::uint32_t i : scope.points) {
    for (const bool outer : {false, true}) {
      if ((outer && point(i).other != kBackground) || is_reached(i, outer)) {
        continue;
      }
      VertexId nearest = kNoVertex;
      sum += std::min(kFarthest, distance_mm(i, outer, nearest) / guide_.limit_mm);
    }
  }
  return sum;
}

std::vector<std::uint32_t> FaultMeter::lonely_points(const Scope& scope) const {
  std::vector<std::uint32_t> lonely;
  for (const std::uint32_t i : scope.points) {
    if (!is_reached(i, false) || (point(i).other == kBackground && !is_reached(i, true))) {
      lonely.push_back(i);
    }
  }
  return lonely;
}

namespace {

using Seeds = std::vector<std::vector<VertexId>>;

using Triangle = std::array<VertexId, 3>;

struct Facets {
  std::vector<Triangle> nodes;   // outer ones first
  std::vector<VertexId> behind;  // of the outer ones
};

Facets all_facets(const LabelledComplex& complex) {
  const MaterialMesh& mesh = complex.mesh();
  Facets facets;
  std::vector<Triangle> inner;
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (!complex.is_facet(t, n)) {
        continue;
      }
      const auto& face = kTetFace[n];
      const Triangle nodes = {mesh.tets[t][face[0]], mesh.tets[t][face[1]], mesh.tets[t][face[2]]};
      if (complex.across(t, n) == kBackground) {
        facets.nodes.push_back(nodes);
        facets.behind.push_back(mesh.tets[t][n]);
      } else {
        inner.push_back(nodes);
      }
    }
  }
  facets.nodes.insert(facets.nodes.end(), inner.begin(), inner.end());
  return facets;
}

/// Pairs of outer facets that fold over a common edge.
std::vector<std::array<std::uint32_t, 2>> folded_facets(const std::vector<Vec3>& points,
                                                        const Facets& facets) {
  struct Side {
    VertexId low, high;
    std::uint32_t facet;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  sides.reserve(3 * facets.behind.size());
  for (std::uint32_t f = 0; f < facets.behind.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(facets.nodes[f][i], facets.nodes[f][(i + 1) % 3]);
      sides.push_back({low, high, f});
    }
  }
  std::sort(sides.begin(), sides.end());
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (std::size_t o = s + 1;
         o < sides.size() && sides[o].low == sides[s].low && sides[o].high == sides[s].high; ++o) {
      const std::uint32_t f = sides[s].facet;
      const std::uint32_t g = sides[o].facet;
      if (facets_fold(points, facets.nodes[f], facets.behind[f], facets.nodes[g], facets.behind[g])) {
        pairs.push_back({f, g});
      }
    }
  }
  return pairs;
}

/// The vertices of each pair.
void add_pairs(const Facets& facets, const std::vector<std::array<std::uint32_t, 2>>& pairs, Seeds& faults) {
  for (const auto& [f, g] : pairs) {
    std::vector<VertexId> seeds(facets.nodes[f].begin(), facets.nodes[f].end());
    seeds.insert(seeds.end(), facets.nodes[g].begin(), facets.nodes[g].end());
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    faults.push_back(std::move(seeds));
  }
}

/// Pinches, and vertices far from their boundary.
void add_vertices(const LabelledComplex& complex, const SurfaceGuide& guide, Seeds& faults) {
  const FaultMeter meter(complex, guide);
  std::vector<std::uint8_t> faulty(complex.mesh().points.size(), 0);
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t v = 0; v < faulty.size(); ++v) {
    const std::vector<VertexId> one = {static_cast<VertexId>(v)};
    faulty[v] = complex.set(one[0]).size > 1 && (meter.pinches(one) > 0 || meter.far(one) > 0) ? 1 : 0;
  }
  for (VertexId v = 0; v < faulty.size(); ++v) {
    if (faulty[v] != 0) {
      faults.push_back({v});
    }
  }
}

/// The vertices next to each place.
void add_nearest_vertices(const LabelledComplex& complex, const std::vector<Vec3>& places, double reach_mm,
                          Seeds& faults) {
  constexpr std::size_t kMost = 6;
  std::vector<std::vector<std::pair<double, VertexId>>> near(places.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (VertexId v = 0; v < complex.mesh().points.size(); ++v) {
      const double squared = (complex.mesh().points[v] - places[p]).squared_norm();
      if (squared <= reach_mm * reach_mm && !complex.star(v).empty()) {
        near[p].emplace_back(squared, v);
      }
    }
    std::sort(near[p].begin(), near[p].end());
  }
  for (const auto& of_place : near) {
    std::vector<VertexId> seeds;
    for (std::size_t i = 0; i < std::min(kMost, of_place.size()); ++i) {
      seeds.push_back(of_place[i].second);
    }
    if (!seeds.empty()) {
      faults.push_back(std::move(seeds));
    }
  }
}

void add_lonely(const LabelledComplex& complex, const SurfaceGuide& guide, Seeds& faults) {
  constexpr std::size_t kMostPlaces = 200;  // each is sought the vertices of by a pass over all
  std::vector<Vec3> places;
  for (const bool outer : {false, true}) {
    std::vector<InterfacePoint> wanted;
    for (InterfacePoint point : guide.points) {
      if (!outer || point.other == kBackground) {
        point.own = outer ? kBackground : point.own;
        point.other = point.own;
        wanted.push_back(point);
      }
    }
    const auto hosts = nearest_hosts(wanted, complex.mesh().points, complex.sets(), guide.limit_mm);
    for (std::size_t p = 0; p < wanted.size() && places.size() < kMostPlaces; ++p) {
      const Vec3 at = wanted[p].centre();
      if (hosts[p] == kNoVertex && std::find(places.begin(), places.end(), at) == places.end()) {
        places.push_back(at);
      }
    }
  }
  add_nearest_vertices(complex, places, 2 * guide.limit_mm, faults);
}

}  // namespace

FaultList find_surface_defects(const LabelledComplex& complex, const SurfaceGuide& guide) {
  FaultList faults;
  const Facets facets = all_facets(complex);
  add_pairs(facets, crossing_facets(complex.mesh().points, facets.nodes), faults.seeds);
  add_pairs(facets, folded_facets(complex.mesh().points, facets), faults.folds);
  faults.cuts = faults.seeds.size();
  add_vertices(complex, guide, faults.seeds);
  add_lonely(complex, guide, faults.seeds);
  return faults;
}

}  // namespace cbc3d
