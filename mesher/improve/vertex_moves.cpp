#include "mesher/improve/vertex_moves.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/star_height.hpp"
#include "mesher/improve/tet_shape.hpp"

namespace cbc3d {
namespace {

void load_link(const TetComplex& mesh, VertexId v, std::span<const TetId> star, Link& link) {
  link.clear();
  for (const TetId t : star) {
    const auto& nodes = mesh.nodes(t);
    const auto& face = kTetFace[mesh.node_index(t, v)];
    link.push_back({mesh.point(nodes[face[0]]), mesh.point(nodes[face[1]]), mesh.point(nodes[face[2]])});
  }
}

/// Squared mean distance of a point to the link's nodes.
double mean_squared_distance(const Link& link, const Vec3& x) {
  double sum = 0;
  for (const auto& face : link) {
    sum += (face[0] - x).squared_norm() + (face[1] - x).squared_norm() + (face[2] - x).squared_norm();
  }
  return sum / (3.0 * static_cast<double>(link.size()));
}

/// A boundary near a vertex, as a plane through it.
struct Plane {
  Vec3 normal;
  double offset_mm;  // distance at the vertex
};

struct VertexMover {
  Patch& patch;
  Link link;
  std::vector<Plane> planes;
  std::vector<std::array<MaterialId, 2>> pairs;

  explicit VertexMover(Patch& p) : patch(p) {}

  /// Loads the star and the boundaries of v; false when v cannot be moved.
  bool load(VertexId v) {
    TetComplex& mesh = patch.mesh;
    if (mesh.locked(v) || !mesh.in_use(v)) {
      return false;
    }
    mesh.star(v, patch.star);
    load_link(mesh, v, patch.star, link);
    pairs.clear();
    planes.clear();
    if (patch.on_boundary(v)) {
      mesh.facets(v, patch.star, patch.facets);
      for (const FacetAt& f : patch.facets) {
        const std::array<MaterialId, 2> pair = {f.inner, f.outer};
        if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) {
          pairs.push_back(pair);
        }
      }
    }
    return true;
  }

  /// Planes of the boundaries at x; false when one of them is not to be found.
  bool find_planes(const Vec3& x) {
    planes.clear();
    for (const auto& [inner, outer] : pairs) {
      const BoundarySample s = patch.boundary.sample(x, inner, outer);
      if (!std::isfinite(s.deviation_mm)) {
        return false;
      }
      planes.push_back({s.normal, s.distance_mm});
    }
    return true;
  }

  [[nodiscard]] double deviation(const Vec3& x) const {
    double largest = 0;
    for (const auto& [inner, outer] : pairs) {
      largest = std::max(largest, patch.boundary.sample(x, inner, outer).deviation_mm);
    }
    return largest;
  }

  /// True when x is near enough to its boundaries, or nearer (in the mean of squares) than the planes say the
  /// vertex was.
  [[nodiscard]] bool stays_near(const Vec3& x) const {
    double before = 0;
    for (const Plane& plane : planes) {
      before += plane.offset_mm * plane.offset_mm;
    }
    double after = 0;
    double largest = 0;
    for (const auto& [inner, outer] : pairs) {
      const double d = patch.boundary.sample(x, inner, outer).deviation_mm;
      after += d * d;
      largest = std::max(largest, d);
    }
    return largest <= patch.guards.deviation_mm || after <= before;
  }

  /// Energy at x + step, or a negative number when a tet would turn over.
  [[nodiscard]] double energy(const Vec3& x, const Vec3& step, double weight) const {
    double sum = 0;
    const Vec3 at = x + step;
    for (const auto& face : link) {
      const double e = shape_energy(at, face[0], face[1], face[2]);
      if (e < 0) {
        return -1;
      }
      sum += e;
    }
    for (const Plane& plane : planes) {
      const double offset = plane.offset_mm + plane.normal.dot(step);
      sum += 0.5 * weight * offset * offset;
    }
    return sum;
  }

  /// Neighbours of v on boundaries, which may take over its points.
  [[nodiscard]] std::span<const VertexId> possible_hosts() {
    patch.around.clear();
    for (const FacetAt& f : patch.facets) {
      for (const VertexId w : {f.first, f.second}) {
        if (std::find(patch.around.begin(), patch.around.end(), w) == patch.around.end()) {
          patch.around.push_back(w);
        }
      }
    }
    return patch.around;
  }

  /// Puts v at `to` when its points keep hosts.
  bool move(VertexId v, const Vec3& to) {
    if (patch.on_boundary(v)) {
      if (!patch.cover.can_release(v, &to, possible_hosts(), patch.mesh, patch.sets)) {
        return false;
      }
      patch.cover.commit(v);
    }
    patch.mesh.move(v, to);
    return true;
  }

  bool strays(VertexId v) { return load(v) && deviation(patch.mesh.point(v)) > patch.guards.deviation_mm; }

  bool relax(VertexId v, const RelaxOptions& options) {
    if (!load(v)) {
      return false;
    }
    const Vec3 x = patch.mesh.point(v);
    if (!pairs.empty() && !find_planes(x)) {
      return false;
    }
    const double h_squared = mean_squared_distance(link, x);
    const double weight = options.surface_weight / (patch.guards.scale_mm * patch.guards.scale_mm);
    ShapeTerm sum;
    for (const auto& face : link) {
      if (!add_shape_term(x, face[0], face[1], face[2], sum)) {
        return false;
      }
    }
    for (const Plane& plane : planes) {
      add_plane_term(plane.normal, plane.offset_mm, weight, sum);
    }
    Vec3 step = newton_step(sum);
    const double length = step.norm();
    const double longest = options.max_step * std::sqrt(h_squared);
    if (!(length > options.skip_below_mm)) {
      return false;
    }
    if (length > longest) {
      step *= longest / length;
    }
    for (int attempt = 0; attempt < 5; ++attempt, step *= 0.5) {
      const double after = energy(x, step, weight);
      if (after >= 0 && after < sum.energy && stays_near(x + step) && move(v, x + step)) {
        return true;
      }
    }
    return false;
  }

  bool climb(VertexId v, double goal) {
    if (!load(v)) {
      return false;
    }
    const Vec3 start = patch.mesh.point(v);
    const double h = std::sqrt(mean_squared_distance(link, start));
    double best = worst_height(link, start, -1e300);
    if (best >= goal) {
      return false;
    }
    const double limit = std::max(patch.guards.deviation_mm, deviation(start));
    bool moved = false;
    for (double length = 0.3 * h; length > 0.004 * h; length *= 0.5) {
      for (int turn = 0; turn < 2 && best < goal && climb_step(v, length, limit, best); ++turn) {
        moved = true;
      }
    }
    return moved;
  }

  /// Takes the first step of a length that lifts the worst angle.
  bool climb_step(VertexId v, double length, double limit, double& best) {
    const Vec3 x = patch.mesh.point(v);
    const Vec3 up = steepest_ascent(link, x, length);
    for (const Vec3& direction : climb_directions(up)) {
      const Vec3 to = x + length * direction;
      const double after = worst_height(link, to, best);
      if (after > best && (pairs.empty() || deviation(to) <= limit) && move(v, to)) {
        best = after;
        return true;
      }
    }
    return false;
  }
};

}  // namespace

std::size_t relax_vertices(Patch& patch, const RelaxOptions& options) {
  VertexMover mover(patch);
  std::size_t moved = 0;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    moved += mover.relax(v, options) ? 1 : 0;
  }
  return moved;
}

std::size_t pull_strays(Patch& patch, const RelaxOptions& options) {
  VertexMover mover(patch);
  std::size_t moved = 0;
  std::vector<VertexId> around;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    for (int turn = 0; turn < 4 && patch.on_boundary(v) && mover.strays(v); ++turn) {
      const std::size_t before = moved;
      moved += mover.relax(v, options) ? 1 : 0;
      patch.mesh.star(v, patch.star);
      patch.mesh.neighbours(v, patch.star, around);
      for (const VertexId w : around) {
        moved += mover.relax(w, options) ? 1 : 0;
      }
      moved += mover.relax(v, options) ? 1 : 0;
      if (moved == before) {
        break;
      }
    }
  }
  return moved;
}

std::size_t climb_vertices(Patch& patch, double goal_sine_squared) {
  VertexMover mover(patch);
  std::size_t moved = 0;
  for (TetId t = 0; t < patch.mesh.tet_slots(); ++t) {
    if (!patch.mesh.alive(t)) {
      continue;
    }
    for (std::size_t n = 0; n < 4 && patch.mesh.sine_squared(t) < goal_sine_squared; ++n) {
      moved += mover.climb(patch.mesh.nodes(t)[n], goal_sine_squared) ? 1 : 0;
    }
  }
  return moved;
}

}  // namespace cbc3d
