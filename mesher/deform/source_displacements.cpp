#include "mesher/deform/source_displacements.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>

namespace cbc3d {
namespace {

/// A source with its surface at its present position.
struct LocalSurface {
  Vec3 position;
  Vec3 normal;         // from the lower material to the higher, zero unless two-sided
  double edge_mm = 0;  // mean length of the surface edges at the source
};

/// A way that a voxel's open faces can look: the sum of their outward normals, each component -1, 0 or 1.
struct Way {
  Vec3 sum;
  std::uint64_t faces = 0;  // bit f: TargetPoint::faces f looks so
};

constexpr std::array<Way, 27> kWays = [] {
  std::array<Way, 27> ways{};
  for (unsigned faces = 0; faces < 64; ++faces) {
    const auto along = [&](unsigned axis) {
      return 1 + (faces >> (2 * axis + 1) & 1U) - (faces >> (2 * axis) & 1U);
    };
    Way& way = ways[along(0) + 3 * along(1) + 9 * along(2)];
    way.sum = {double(along(0)) - 1, double(along(1)) - 1, double(along(2)) - 1};
    way.faces |= std::uint64_t{1} << faces;
  }
  return ways;
}();

/// Which targets a source listens to: those whose open faces do not look against its surface.
class Judge {
 public:
  /// All are heard.
  Judge() = default;
  /// `normal`: from the lower material to the higher.
  explicit Judge(const Vec3& normal) {
    // Two ways that look opposite at a time: 13 in the middle is none, and always heard.
    for (std::size_t w = 0; w < kWays.size() / 2; ++w) {
      const double along = normal.dot(kWays[w].sum);
      const std::uint64_t opposite = kWays[kWays.size() - 1 - w].faces;
      heard_[1] &= ~(along < 0 ? kWays[w].faces : along > 0 ? opposite : 0);
      heard_[0] &= ~(along > 0 ? kWays[w].faces : along < 0 ? opposite : 0);
    }
  }
  [[nodiscard]] bool hears(const TargetPoint& target) const {
    return (heard_[target.lower_side] >> target.faces & 1U) != 0;
  }

 private:
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
  std::array<std::uint64_t, 2> heard_ = {kAll, kAll};  // a bit by TargetPoint::faces; of lower_side 0, 1
};

/// What one call for all sources works with.
class Search {
 public:
  Search(const Correspondence& points, const TargetRows& rows, const std::vector<Vec3>& positions,
         const DisplacementOptions& options)
      : points_(points), rows_(rows), positions_(positions), options_(options) {}

  SourceDisplacement of(std::size_t s, NearTargets& near) const {
    const SourcePoint& source = points_.sources.sources[s];
    const LocalSurface surface = surface_at(s);
    SourceDisplacement found;
    found.matched = mean_vector(source, surface, near, found.vector) ||
                    nearest_vector(source, surface, near, found.vector);
    if (options_.along_normal && source.two_sided) {
      found.vector = found.vector.dot(surface.normal) * surface.normal;
    }
    const double length = found.vector.norm();
    if (length > surface.edge_mm) {
      found.vector *= surface.edge_mm / length;
    }
    return found;
  }

  /// Calls visit(target, squared distance) for the targets of the set of s within `radius` of a place.
  template <typename Visit>
  void for_pairs(std::size_t s, const Vec3& at, double radius, NearTargets& near, const Visit& visit) const {
    const std::uint32_t set = points_.sources.sources[s].set;
    rows_.find(
        at, radius, [set](const TargetPoint& t) { return t.set == set; }, near);
    for (std::size_t h = 0; h < near.count; ++h) {
      const std::uint32_t t = near.hits[h].target;
      visit(t, pair_vector(rows_.target(t), rows_.to_centre(near, near.hits[h])).squared_norm());
    }
  }

  /// From a position to a target: its centre, or the nearest of its open faces.
  [[nodiscard]] Vec3 pair_vector(const TargetPoint& target, const Vec3& to_centre) const {
    if (options_.target_position == TargetPosition::voxel_centre) {
      return to_centre;
    }
    Vec3 nearest;
    double shortest = std::numeric_limits<double>::max();
    for (unsigned f = 0; f < 6; ++f) {
      if ((target.faces >> f & 1U) != 0) {
        Vec3 to_face = to_centre;
        const int axis = static_cast<int>(f / 2);
        to_face[axis] += (f % 2 == 0 ? -0.5 : 0.5) * points_.frame.spacing_mm[axis];
        if (to_face.squared_norm() < shortest) {
          shortest = to_face.squared_norm();
          nearest = to_face;
        }
      }
    }
    return nearest;
  }

 private:
  [[nodiscard]] LocalSurface surface_at(std::size_t s) const {
    const SourcePoints& sources = points_.sources;
    const VertexId own = sources.sources[s].vertex;
    LocalSurface surface;
    surface.position = positions_[own];
    for (std::uint32_t f = sources.first[s]; f < sources.first[s + 1]; ++f) {
      const auto& nodes = sources.interface[sources.facets[f]].nodes;
      const std::size_t count = nodes[3] == kNoVertex ? 3 : 4;
      const auto place = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), own) - nodes.begin());
      const Vec3 next = positions_[nodes[(place + 1) % count]] - surface.position;
      const Vec3 last = positions_[nodes[(place + count - 1) % count]] - surface.position;
      surface.edge_mm += next.norm() + last.norm();
      surface.normal += next.cross(last);
    }
    surface.edge_mm /= 2.0 * (sources.first[s + 1] - sources.first[s]);
    surface.normal = sources.sources[s].two_sided ? surface.normal.normalized() : Vec3{};
    return surface;
  }

  /// Calls pull(vector, weight) for what a target offers: its centre, or its faces as far as they look the
  /// surface's way. Whether a centre is heard is asked before.
  template <typename Pull>
  void offer(bool judged, const LocalSurface& surface, const TargetPoint& target, const Vec3& to_centre,
             const Pull& pull) const {
    if (options_.target_position == TargetPosition::voxel_centre) {
      pull(to_centre, 1.0);
      return;
    }
    const Vec3 outward = target.lower_side != 0 ? surface.normal : -surface.normal;
    for (unsigned faces = target.faces; faces != 0; faces &= faces - 1) {
      const int f = std::countr_zero(faces);
      const int axis = f / 2;
      const double side = f % 2 == 0 ? -1 : 1;
      const double weight = judged ? side * outward[axis] : 1;
      if (weight > 0) {
        Vec3 to_face = to_centre;
        to_face[axis] += 0.5 * side * points_.frame.spacing_mm[axis];
        pull(to_face, weight);
      }
    }
  }

  [[nodiscard]] bool is_judged(const SourcePoint& source) const {
    return source.two_sided && options_.reject_outliers;
  }
  /// Of the centres; faces are weighed one by one.
  [[nodiscard]] Judge judge_of(const SourcePoint& source, const LocalSurface& surface) const {
    return is_judged(source) && options_.target_position == TargetPosition::voxel_centre
               ? Judge(surface.normal)
               : Judge();
  }

  /// How far beyond a ball the centres of voxels lie whose targets are in it.
  [[nodiscard]] double centre_margin() const {
    return options_.target_position == TargetPosition::voxel_faces ? points_.frame.spacing_mm.max_coeff() / 2
                                                                   : 0;
  }

  bool mean_vector(const SourcePoint& source, const LocalSurface& surface, NearTargets& near,
                   Vec3& mean) const {
    const double radius = surface.edge_mm;
    const Judge judge = judge_of(source, surface);
    rows_.find(
        surface.position, radius + centre_margin(),
        [&judge, set = source.set](const TargetPoint& t) {
          return (static_cast<unsigned>(t.set == set) & static_cast<unsigned>(judge.hears(t))) != 0;
        },
        near);
    Vec3 sum;
    double total = 0;
    for (std::size_t h = 0; h < near.count; ++h) {
      const NearTargets::Hit& hit = near.hits[h];
      offer(is_judged(source), surface, rows_.target(hit.target), rows_.to_centre(near, hit),
            [&](const Vec3& vector, double weight) {
              if (vector.squared_norm() <= radius * radius) {
                sum += weight * vector;
                total += weight;
              }
            });
    }
    mean = total > 0 ? sum / total : Vec3{};
    return total > 0;
  }

  /// How far a target's material set is from a source's: 0 equal, 1 one within the other, 2 both of two with
  /// one in common.
  [[nodiscard]] int mismatch(const SourcePoint& source, const TargetPoint& target) const {
    if (source.set == target.set) {
      return 0;
    }
    const MaterialSet& s = points_.sets[source.set];
    const MaterialSet& t = points_.sets[target.set];
    if (s.is_within(t) || t.is_within(s)) {
      return 1;
    }
    return s.size == 2 && t.size == 2 && (s[0] == t[0] || s[0] == t[1] || s[1] == t[0] || s[1] == t[1]) ? 2
                                                                                                        : 3;
  }

  /// For sources without a target in their region: the nearest beyond, of the best matching sets.
  bool nearest_vector(const SourcePoint& source, const LocalSurface& surface, NearTargets& near,
                      Vec3& nearest) const {
    const Judge judge = judge_of(source, surface);
    rows_.find(
        surface.position, options_.reach * surface.edge_mm + centre_margin(),
        [&judge](const TargetPoint& t) { return judge.hears(t); }, near);
    int best = 3;
    double shortest = std::numeric_limits<double>::max();
    for (std::size_t h = 0; h < near.count; ++h) {
      const TargetPoint& target = rows_.target(near.hits[h].target);
      const int differs = mismatch(source, target);
      if (differs > best || differs == 3) {
        continue;
      }
      offer(is_judged(source), surface, target, rows_.to_centre(near, near.hits[h]),
            [&](const Vec3& vector, double) {
              const double square = vector.squared_norm();
              if (differs < best || square < shortest) {
                best = differs;
                shortest = square;
                nearest = vector;
              }
            });
    }
    return best < 3;
  }

  const Correspondence& points_;
  const TargetRows& rows_;
  const std::vector<Vec3>& positions_;
  const DisplacementOptions& options_;
};

constexpr std::uint64_t kNoPair = ~std::uint64_t{0};

/// A squared distance and a number in one key, ordered by distance first.
std::uint64_t pair_key(double square, std::size_t number) {
  return static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(static_cast<float>(square))) << 32U | number;
}
std::size_t number_of(std::uint64_t key) {
  return key & 0xFFFFFFFFU;
}

/// True when the distance of a pair is surely no more than that, for all that the key is rounded.
bool is_within(std::uint64_t key, double most_mm) {
  constexpr double kRounding = 1e-6;
  return std::bit_cast<float>(static_cast<std::uint32_t>(key >> 32U)) < (1 - kRounding) * most_mm * most_mm;
}

/// Sets a value that several threads may lower to the lowest that they give.
void lower(std::uint64_t& value, std::uint64_t key) {
  const std::atomic_ref<std::uint64_t> shared(value);
  std::uint64_t present = shared.load(std::memory_order_relaxed);
  while (key < present && !shared.compare_exchange_weak(present, key, std::memory_order_relaxed)) {
  }
}

void forget(std::vector<std::uint64_t>& pairs, std::size_t count) {
  pairs.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < count; ++p) {
    pairs[p] = kNoPair;
  }
}

}  // namespace

std::vector<SourceDisplacement> SourceDisplacements::at(const std::vector<Vec3>& positions) {
  const Search search(points_, rows_, positions, options_);
  std::vector<SourceDisplacement> found(points_.sources.sources.size());
#pragma omp parallel
  {
    NearTargets near;
#pragma omp for schedule(dynamic, 32)
    for (std::size_t s = 0; s < found.size(); ++s) {
      found[s] = search.of(s, near);
    }
  }
  if (options_.pair_distance > 0) {
    pull_pairs(positions, options_.pair_distance * points_.frame.voxel_diagonal_mm(), found);
  }
  return found;
}

/// Makes sure that no source stays farther than `most_mm` from the nearest target, and no target from the
/// nearest source: of a pair that would, the source is pulled all the way that lacks, along the surface too.
void SourceDisplacements::pull_pairs(const std::vector<Vec3>& positions, double most_mm,
                                     std::vector<SourceDisplacement>& found) {
  const Search search(points_, rows_, positions, options_);
  const auto moved = [&](std::size_t s) {
    return positions[points_.sources.sources[s].vertex] + found[s].vector;
  };
  forget(source_of_target_, points_.targets.targets.size());
  target_of_source_.resize(found.size());
#pragma omp parallel
  {
    NearTargets near;
#pragma omp for schedule(dynamic, 32)
    for (std::size_t s = 0; s < found.size(); ++s) {
      std::uint64_t nearest = kNoPair;
      search.for_pairs(s, moved(s), 3 * most_mm, near, [&](std::uint32_t t, double square) {
        lower(source_of_target_[t], pair_key(square, s));
        nearest = std::min(nearest, pair_key(square, t));
      });
      // Held as the complement, so that the farthest target pulls.
      target_of_source_[s] = nearest == kNoPair ? kNoPair : ~nearest;
    }
  }
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < source_of_target_.size(); ++t) {
    const std::uint64_t pair = source_of_target_[t];
    if (pair != kNoPair && !is_within(pair, most_mm)) {
      lower(target_of_source_[number_of(pair)], ~((pair & ~std::uint64_t{0xFFFFFFFFU}) | t));
    }
  }
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < found.size(); ++s) {
    if (target_of_source_[s] != kNoPair && !is_within(~target_of_source_[s], most_mm)) {
      const auto t = static_cast<std::uint32_t>(number_of(~target_of_source_[s]));
      const Vec3 lacking = search.pair_vector(rows_.target(t), rows_.centre(t) - moved(s));
      const double length = lacking.norm();
      if (length > most_mm) {
        found[s].vector += (1 - most_mm / length) * lacking;
        found[s].matched = true;
      }
    }
  }
}

}  // namespace cbc3d
