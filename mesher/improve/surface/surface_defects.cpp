#include "mesher/improve/surface/surface_defects.hpp"

#include <limits>

#include "mesher/improve/surface/self_intersections.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kFarthest = 2;      // in units of the limit: what is farther counts as this
constexpr double kSearchLimits = 2;  // likewise: no step takes a vertex from beyond this to within the limit

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
  const bool topology_no_worse =
      may_trade ? topological() <= other.topological()
                : pinches <= other.pinches && self_intersections <= other.self_intersections;
  const bool no_worse = topology_no_worse && far <= other.far && uncovered <= other.uncovered;
  return no_worse && (topological() < other.topological() || far < other.far - kTiny ||
                      uncovered < other.uncovered - kTiny || folds < other.folds);
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

void DefectMeter::make_grids() {
  vertex_grid_ = PlaceGrid(2 * limit_mm_);
  for (VertexId v = 0; v < complex_.mesh().points.size(); ++v) {
    if (!complex_.star(v).empty()) {
      vertex_grid_.add(complex_.mesh().points[v], v);
    }
  }
  vertex_grid_.sort();
  sample_grid_ = PlaceGrid(2 * limit_mm_);
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    sample_grid_.add(samples_[s].centre(), s);
  }
  sample_grid_.sort();
  has_grids_ = true;
}

bool DefectMeter::look_at(std::span<const VertexId> vertices) {
  if (!has_grids_) {
    make_grids();
  }
  Box box;
  for (const VertexId v : vertices) {
    box.add(complex_.mesh().points[v]);
  }
  near_samples_.clear();
  box.grow(2 * limit_mm_);
  sample_grid_.for_each_near(box.low, box.high, [&](std::uint32_t s) { near_samples_.push_back(s); });
  std::sort(near_samples_.begin(), near_samples_.end());
  std::vector<VertexId> near;
  box.grow(limit_mm_);
  vertex_grid_.for_each_near(box.low, box.high, [&](VertexId v) { near.push_back(v); });
  std::sort(near.begin(), near.end());
  constexpr std::size_t kMostPairs = 20000000;  // of a sample and a vertex
  if (near_samples_.size() * near.size() > kMostPairs) {
    return false;
  }
  list_vertices_near_samples(near);
  list_facets_near(near);
  return true;
}

void DefectMeter::list_vertices_near_samples(const std::vector<VertexId>& vertices) {
  const double search_squared = kSearchLimits * kSearchLimits * limit_mm_ * limit_mm_;
  first_near_.assign(1, 0);
  near_.clear();
  for (const std::uint32_t s : near_samples_) {
    const Vec3 at = samples_[s].centre();
    for (const VertexId v : vertices) {
      if ((complex_.mesh().points[v] - at).squared_norm() <= search_squared) {
        near_.push_back(v);
      }
    }
    first_near_.push_back(static_cast<std::uint32_t>(near_.size()));
  }
}

void DefectMeter::list_facets_near(const std::vector<VertexId>& vertices) {
  std::vector<TetId> tets;
  for (const VertexId v : vertices) {
    if (complex_.set(v).has(kBackground)) {
      tets.insert(tets.end(), complex_.star(v).begin(), complex_.star(v).end());
    }
  }
  facets_.clear();
  add_facets(tets, facets_);
}

void DefectMeter::add_facets(std::vector<TetId>& tets, std::vector<Facet>& facets) const {
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

DefectMeter::Scope DefectMeter::scope_of(std::vector<VertexId> vertices) const {
  Scope scope;
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const double search_squared = kSearchLimits * kSearchLimits * limit_mm_ * limit_mm_;
  for (std::uint32_t i = 0; i < near_samples_.size(); ++i) {
    const Vec3 at = samples_[near_samples_[i]].centre();
    if (std::any_of(vertices.begin(), vertices.end(), [&](VertexId v) {
          return (complex_.mesh().points[v] - at).squared_norm() <= search_squared;
        })) {
      scope.samples.push_back(i);
    }
  }
  scope.vertices = std::move(vertices);
  return scope;
}

SurfaceDefects DefectMeter::measure(const Scope& scope, std::size_t most) const {
  SurfaceDefects defects;
  defects.pinches = pinches(scope.vertices);
  if (defects.pinches <= most) {
    count_intersections_and_folds(scope.vertices, defects);
    defects.far = far(scope.vertices);
    defects.uncovered = uncovered(scope);
  }
  return defects;
}

std::size_t DefectMeter::pinches(const std::vector<VertexId>& vertices) const {
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

double DefectMeter::far(const std::vector<VertexId>& vertices) const {
  double sum = 0;
  for (const VertexId v : vertices) {
    const MaterialSet& set = complex_.set(v);
    const Vec3& at = complex_.mesh().points[v];
    for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
      if (!domain_.is_near_boundary(at, set.ids[i])) {
        const auto nearest = domain_.nearest_boundary(at, set.ids[i]);
        sum += nearest ? (*nearest - at).norm() / limit_mm_ : kFarthest;
      }
    }
  }
  return sum;
}

DefectMeter::Facet DefectMeter::facet(TetId t, std::size_t n) const {
  Facet facet{};
  facet.is_outer = complex_.across(t, n) == kBackground;
  facet.behind = complex_.mesh().tets[t][n];
  Box box;
  for (std::size_t i = 0; i < 3; ++i) {
    facet.nodes[i] = complex_.mesh().tets[t][kTetFace[n][i]];
    box.add(complex_.mesh().points[facet.nodes[i]]);
  }
  box.grow(1e-6 * limit_mm_);
  facet.low = box.low;
  facet.high = box.high;
  return facet;
}

void DefectMeter::count_intersections_and_folds(const std::vector<VertexId>& vertices,
                                                SurfaceDefects& defects) const {
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
        defects.self_intersections += facets_intersect(points, f.nodes, g.nodes) ? 1 : 0;
        const bool may_fold = f.is_outer && g.is_outer;
        defects.folds += may_fold && facets_fold(points, f.nodes, f.behind, g.nodes, g.behind) ? 1 : 0;
      }
    }
  }
}

bool DefectMeter::is_on(VertexId v, std::uint32_t sample, bool outer) const {
  const MaterialSet& set = complex_.set(v);
  if (set.size < 2 || outer) {
    return set.size > 1 && set.has(kBackground);
  }
  const MaterialId label = domain_.label_of()[samples_[sample].own];
  return std::any_of(set.ids.begin(), set.ids.begin() + set.size,
                     [&](MaterialId m) { return domain_.label_of()[m] == label; });
}

double DefectMeter::distance_mm(std::uint32_t i, bool outer, VertexId& nearest) const {
  const Vec3 at = sample(i).centre();
  double least = kInfinity;
  for (std::uint32_t n = first_near_[i]; n < first_near_[i + 1]; ++n) {
    const double squared = (complex_.mesh().points[near_[n]] - at).squared_norm();
    if (squared < least && is_on(near_[n], near_samples_[i], outer)) {
      least = squared;
      nearest = near_[n];
    }
  }
  return std::sqrt(least);
}

bool DefectMeter::is_covered(std::uint32_t i, bool outer) const {
  const Vec3 at = sample(i).centre();
  return std::any_of(near_.begin() + first_near_[i], near_.begin() + first_near_[i + 1], [&](VertexId v) {
    return (complex_.mesh().points[v] - at).squared_norm() <= limit_mm_ * limit_mm_ &&
           is_on(v, near_samples_[i], outer);
  });
}

double DefectMeter::uncovered(const Scope& scope) const {
  double sum = 0;
  for (const std::uint32_t i : scope.samples) {
    for (const bool outer : {false, true}) {
      if ((outer && sample(i).other != kBackground) || is_covered(i, outer)) {
        continue;
      }
      VertexId nearest = kNoVertex;
      sum += std::min(kFarthest, distance_mm(i, outer, nearest) / limit_mm_);
    }
  }
  return sum;
}

std::vector<std::uint32_t> DefectMeter::uncovered_samples(const Scope& scope) const {
  std::vector<std::uint32_t> uncovered;
  for (const std::uint32_t i : scope.samples) {
    if (!is_covered(i, false) || (sample(i).other == kBackground && !is_covered(i, true))) {
      uncovered.push_back(i);
    }
  }
  return uncovered;
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

/// Pairs of outer facets that are folded at a common edge.
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

/// Adds the vertices of each pair.
void add_pairs(const Facets& facets, const std::vector<std::array<std::uint32_t, 2>>& pairs, Seeds& defects) {
  for (const auto& [f, g] : pairs) {
    std::vector<VertexId> seeds(facets.nodes[f].begin(), facets.nodes[f].end());
    seeds.insert(seeds.end(), facets.nodes[g].begin(), facets.nodes[g].end());
    std::sort(seeds.begin(), seeds.end());
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    defects.push_back(std::move(seeds));
  }
}

/// Adds pinches and far vertices.
void add_vertices(const LabelledComplex& complex, const Domain& domain, double limit_mm, Seeds& defects) {
  const DefectMeter meter(complex, domain, limit_mm);
  std::vector<std::uint8_t> defective(complex.mesh().points.size(), 0);
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t v = 0; v < defective.size(); ++v) {
    const std::vector<VertexId> one = {static_cast<VertexId>(v)};
    defective[v] = complex.set(one[0]).size > 1 && (meter.pinches(one) > 0 || meter.far(one) > 0) ? 1 : 0;
  }
  for (VertexId v = 0; v < defective.size(); ++v) {
    if (defective[v] != 0) {
      defects.push_back({v});
    }
  }
}

/// Adds the vertices next to each place.
void add_nearest_vertices(const LabelledComplex& complex, const std::vector<Vec3>& places, double search_mm,
                          Seeds& defects) {
  constexpr std::size_t kMost = 6;
  std::vector<std::vector<std::pair<double, VertexId>>> near(places.size());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < places.size(); ++p) {
    for (VertexId v = 0; v < complex.mesh().points.size(); ++v) {
      const double squared = (complex.mesh().points[v] - places[p]).squared_norm();
      if (squared <= search_mm * search_mm && !complex.star(v).empty()) {
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
      defects.push_back(std::move(seeds));
    }
  }
}

void add_uncovered(const LabelledComplex& complex, const Domain& domain, double limit_mm, Seeds& defects) {
  constexpr std::size_t kMostPlaces = 200;  // each costs one scan over all vertices
  std::vector<Vec3> places;
  for (const bool outer : {false, true}) {
    std::vector<BoundarySample> wanted;
    for (BoundarySample sample : domain.samples()) {
      if (!outer || sample.other == kBackground) {
        sample.own = outer ? kBackground : sample.own;
        sample.other = sample.own;
        wanted.push_back(sample);
      }
    }
    const auto covering = nearest_covering_vertices(wanted, complex.mesh().points, complex.sets(), limit_mm);
    for (std::size_t s = 0; s < wanted.size() && places.size() < kMostPlaces; ++s) {
      const Vec3 at = wanted[s].centre();
      if (covering[s] == kNoVertex && std::find(places.begin(), places.end(), at) == places.end()) {
        places.push_back(at);
      }
    }
  }
  add_nearest_vertices(complex, places, kSearchLimits * limit_mm, defects);
}

}  // namespace

DefectList find_surface_defects(const LabelledComplex& complex, const Domain& domain, double limit_mm) {
  DefectList defects;
  const Facets facets = all_facets(complex);
  add_pairs(facets, intersecting_facets(complex.mesh().points, facets.nodes), defects.seeds);
  add_pairs(facets, folded_facets(complex.mesh().points, facets), defects.folds);
  defects.self_intersections = defects.seeds.size();
  add_vertices(complex, domain, limit_mm, defects.seeds);
  add_uncovered(complex, domain, limit_mm, defects.seeds);
  return defects;
}

}  // namespace cbc3d
