#include "mesher/stages/source_displacements.hpp"

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

/// Sums of the outward normals of open faces, by TargetPoint::faces.
constexpr std::array<Vec3, 64> kOpenSides = [] {
  std::array<Vec3, 64> sums{};
  for (unsigned faces = 0; faces < 64; ++faces) {
    sums[faces] = {double(faces >> 1U & 1U) - double(faces & 1U),
                   double(faces >> 3U & 1U) - double(faces >> 2U & 1U),
                   double(faces >> 5U & 1U) - double(faces >> 4U & 1U)};
  }
  return sums;
}();

class TargetSearch {
 public:
  TargetSearch(const Correspondence& points, const std::vector<Vec3>& positions,
               const DisplacementOptions& options)
      : points_(points), positions_(positions), options_(options) {}

  [[nodiscard]] SourceDisplacement of(std::size_t s) const {
    const SourcePoint& source = points_.sources.sources[s];
    const LocalSurface surface = surface_at(s);
    SourceDisplacement found;
    found.matched =
        mean_vector(source, surface, found.vector) || nearest_vector(source, surface, found.vector);
    if (options_.along_normal && source.two_sided) {
      found.vector = found.vector.dot(surface.normal) * surface.normal;
    }
    const double length = found.vector.norm();
    if (length > surface.edge_mm) {
      found.vector *= surface.edge_mm / length;
    }
    return found;
  }

  /// Makes sure that no source stays farther than `most_mm` from the nearest target, and no target from the
  /// nearest source: of a pair that would, the source is pulled all the way that lacks, along the surface
  /// too.
  void pull_pairs(double most_mm, std::vector<SourceDisplacement>& found) const {
    const std::size_t count = found.size();
    std::vector<std::atomic<std::uint64_t>> source_of_target(points_.targets.targets.size());
    std::vector<std::atomic<std::uint64_t>> target_of_source(count);
    for (auto& nearest : source_of_target) {
      nearest = kNoPair;
    }
    const TargetPoint* const first = points_.targets.targets.data();
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t s = 0; s < count; ++s) {
      std::uint64_t nearest = kNoPair;
      for_pairs(s, 3 * most_mm, found, [&](const TargetPoint& t, double square) {
        lower(source_of_target[static_cast<std::size_t>(&t - first)], pair_key(square, s));
        nearest = std::min(nearest, pair_key(square, static_cast<std::size_t>(&t - first)));
      });
      // Held as the complement, so that the farthest target pulls.
      target_of_source[s] = nearest == kNoPair ? kNoPair : ~nearest;
    }
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < source_of_target.size(); ++t) {
      const std::uint64_t pair = source_of_target[t];
      if (pair != kNoPair) {
        lower(target_of_source[pair & 0xFFFFFFFFU], ~((pair & ~std::uint64_t{0xFFFFFFFFU}) | t));
      }
    }
    const std::vector<Vec3> centres = target_centres();
#pragma omp parallel for schedule(static)
    for (std::size_t s = 0; s < count; ++s) {
      if (target_of_source[s] != kNoPair) {
        const std::size_t t = ~target_of_source[s] & 0xFFFFFFFFU;
        const Vec3 lacking = pair_vector(points_.targets.targets[t], centres[t], moved(s, found));
        const double length = lacking.norm();
        if (length > most_mm) {
          found[s].vector += (1 - most_mm / length) * lacking;
          found[s].matched = true;
        }
      }
    }
  }

 private:
  static constexpr std::uint64_t kNoPair = ~std::uint64_t{0};

  /// A squared distance and a number in one key, ordered by distance first.
  static std::uint64_t pair_key(double square, std::size_t number) {
    return static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(static_cast<float>(square))) << 32U |
           number;
  }
  static void lower(std::atomic<std::uint64_t>& value, std::uint64_t key) {
    std::uint64_t present = value;
    while (key < present && !value.compare_exchange_weak(present, key)) {
    }
  }
  [[nodiscard]] Vec3 moved(std::size_t s, const std::vector<SourceDisplacement>& found) const {
    return positions_[points_.sources.sources[s].vertex] + found[s].vector;
  }
  /// From a position to a target: its centre, or the nearest of its open faces.
  [[nodiscard]] Vec3 pair_vector(const TargetPoint& target, const Vec3& centre, const Vec3& at) const {
    const Vec3 to_centre = centre - at;
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

  /// Calls visit(target, squared distance) for the targets of the set of s near where it moves to.
  template <typename Visit>
  void for_pairs(std::size_t s, double radius, const std::vector<SourceDisplacement>& found,
                 const Visit& visit) const {
    const Vec3 at = moved(s, found);
    for_targets_near(at, radius, [&](const TargetPoint& t, const Vec3& centre) {
      if (t.set == points_.sources.sources[s].set) {
        visit(t, pair_vector(t, centre, at).squared_norm());
      }
    });
  }
  [[nodiscard]] std::vector<Vec3> target_centres() const {
    const TargetPoints& targets = points_.targets;
    std::vector<Vec3> centres(targets.targets.size());
    const auto rows = static_cast<std::size_t>(points_.frame.size[1]);
    const std::size_t row_count = targets.first.size() - 1;
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t r = 0; r < row_count; ++r) {
      for (std::uint64_t t = targets.first[r]; t < targets.first[r + 1]; ++t) {
        centres[t] = points_.frame.local_centre(targets.targets[t].i, static_cast<int>(r % rows),
                                                static_cast<int>(r / rows));
      }
    }
    return centres;
  }

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

  /// Calls visit(target, its voxel's centre) for the targets whose voxel centre is in the ball.
  template <typename Visit>
  void for_targets_near(const Vec3& position, double radius, const Visit& visit) const {
    const ImageFrame& frame = points_.frame;
    const auto range = [&](int axis) {
      const double spacing = frame.spacing_mm[axis];
      const int size = frame.size[static_cast<std::size_t>(axis)];
      return std::pair{std::max(0, static_cast<int>(std::ceil((position[axis] - radius) / spacing))),
                       std::min(size - 1, static_cast<int>(std::floor((position[axis] + radius) / spacing)))};
    };
    const auto [i_first, i_last] = range(0);
    const auto [j_first, j_last] = range(1);
    const auto [k_first, k_last] = range(2);
    for (int k = k_first; k <= k_last; ++k) {
      const double z = k * frame.spacing_mm.z;
      const double left_z = radius * radius - (z - position.z) * (z - position.z);
      for (int j = j_first; j <= j_last; ++j) {
        const double y = j * frame.spacing_mm.y;
        const double left = left_z - (y - position.y) * (y - position.y);
        const std::size_t row = static_cast<std::size_t>(k) * static_cast<std::size_t>(frame.size[1]) +
                                static_cast<std::size_t>(j);
        const TargetPoint* const row_end = points_.targets.targets.data() + points_.targets.first[row + 1];
        const TargetPoint* t = points_.targets.targets.data() + points_.targets.first[row];
        if (t == row_end || left < 0) {
          continue;
        }
        for (t = first_from(t, row_end, i_first); t != row_end && t->i <= i_last; ++t) {
          const double x = t->i * frame.spacing_mm.x;
          if ((x - position.x) * (x - position.x) <= left) {
            visit(*t, Vec3{x, y, z});
          }
        }
      }
    }
  }

  /// The first target of a row whose index is at least i. Most rows have none or a few.
  static const TargetPoint* first_from(const TargetPoint* t, const TargetPoint* row_end, int i) {
    constexpr std::ptrdiff_t kFew = 8;
    if (row_end - t > kFew) {
      return std::lower_bound(t, row_end, i, [](const TargetPoint& a, int b) { return a.i < b; });
    }
    while (t != row_end && t->i < i) {
      ++t;
    }
    return t;
  }

  /// Calls pull(vector, weight) for what a target offers: its centre, or its faces as far as they look the
  /// surface's way.
  template <typename Pull>
  void offer(const SourcePoint& source, const LocalSurface& surface, const TargetPoint& target,
             const Vec3& centre, const Pull& pull) const {
    const Vec3 outward = target.lower_side ? surface.normal : -surface.normal;
    const Vec3 to_centre = centre - surface.position;
    const bool judged = source.two_sided && options_.reject_outliers;
    if (options_.target_position == TargetPosition::voxel_centre) {
      if (!judged || !(outward.dot(kOpenSides[target.faces & 63U]) < 0)) {
        pull(to_centre, 1.0);
      }
      return;
    }
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

  /// How far beyond a ball the centres of voxels lie whose targets are in it.
  [[nodiscard]] double centre_margin() const {
    return options_.target_position == TargetPosition::voxel_faces ? points_.frame.spacing_mm.max_coeff() / 2
                                                                   : 0;
  }

  bool mean_vector(const SourcePoint& source, const LocalSurface& surface, Vec3& mean) const {
    const double radius = surface.edge_mm;
    Vec3 sum;
    double total = 0;
    for_targets_near(surface.position, radius + centre_margin(),
                     [&](const TargetPoint& t, const Vec3& centre) {
                       if (t.set == source.set) {
                         offer(source, surface, t, centre, [&](const Vec3& vector, double weight) {
                           if (vector.squared_norm() <= radius * radius) {
                             sum += weight * vector;
                             total += weight;
                           }
                         });
                       }
                     });
    mean = total > 0 ? sum / total : Vec3{};
    return total > 0;
  }

  /// How far a target's label set is from a source's: 0 equal, 1 one within the other, 2 both of two with one
  /// in common.
  [[nodiscard]] int mismatch(const SourcePoint& source, const TargetPoint& target) const {
    if (source.set == target.set) {
      return 0;
    }
    const LabelSet& s = points_.sets[source.set];
    const LabelSet& t = points_.sets[target.set];
    if (s.is_within(t) || t.is_within(s)) {
      return 1;
    }
    return s.size() == 2 && t.size() == 2 && (s[0] == t[0] || s[0] == t[1] || s[1] == t[0] || s[1] == t[1])
               ? 2
               : 3;
  }

  /// For sources without a target in their region: the nearest beyond, of the best matching sets.
  bool nearest_vector(const SourcePoint& source, const LocalSurface& surface, Vec3& nearest) const {
    int best = 3;
    double shortest = std::numeric_limits<double>::max();
    for_targets_near(surface.position, options_.reach * surface.edge_mm + centre_margin(),
                     [&](const TargetPoint& t, const Vec3& centre) {
                       const int differs = mismatch(source, t);
                       if (differs > best || differs == 3) {
                         return;
                       }
                       offer(source, surface, t, centre, [&](const Vec3& vector, double) {
                         const double square = vector.squared_norm();
                         if (differs < best || square < shortest) {
                           best = differs;
                           shortest = square;
                           nearest = vector;
                         }
                       });
                     });
    return best < 3;
  }

  const Correspondence& points_;
  const std::vector<Vec3>& positions_;
  const DisplacementOptions& options_;
};

}  // namespace

std::vector<SourceDisplacement> source_displacements(const Correspondence& points,
                                                     const std::vector<Vec3>& positions,
                                                     const DisplacementOptions& options) {
  const TargetSearch search(points, positions, options);
  std::vector<SourceDisplacement> found(points.sources.sources.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t s = 0; s < found.size(); ++s) {
    found[s] = search.of(s);
  }
  if (options.pair_distance > 0) {
    search.pull_pairs(options.pair_distance * points.frame.voxel_diagonal_mm(), found);
  }
  return found;
}

}  // namespace cbc3d
