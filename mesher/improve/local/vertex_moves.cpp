#include "mesher/improve/local/vertex_moves.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mesher/improve/local/star_quality.hpp"
#include "mesher/improve/local/surface_neighbours.hpp"
#include "mesher/improve/local/tet_shape.hpp"

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

/// Weights of the squared offsets of planes, per mm^2.
struct Weights {
  double boundary, flat;
};

enum class Step { taken, none_needed, refused };

struct VertexMover {
  Patch& patch;
  Link link;
  std::vector<Plane> planes;
  std::vector<Plane> flat;   // in which the neighbours on the same interface would have the vertex
  std::vector<Vec3> normal;  // of vertices on one interface alone, zero elsewhere; empty: no smoothness
  std::vector<std::array<MaterialId, 2>> pairs;
  std::vector<SurfaceNeighbour> beside;  // scratch

  explicit VertexMover(Patch& p) : patch(p) {}

  /// Loads the star and the boundaries of v; false when v cannot be moved.
  bool load(VertexId v) {
    TetComplex& mesh = patch.mesh;
    if (!mesh.free(v) || !mesh.in_use(v)) {
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

  /// Finds the planes of the boundaries at x; false when one of the boundaries is not near.
  bool find_planes(const Vec3& x) {
    planes.clear();
    for (const auto& [inner, outer] : pairs) {
      const BoundaryDistance d = patch.boundaries.distance(x, inner, outer);
      if (!std::isfinite(d.deviation_mm)) {
        return false;
      }
      planes.push_back({d.normal, d.distance_mm});
    }
    return true;
  }

  /// The normals of all vertices that are on a single interface and may move; of locked ones not all facets
  /// are in the patch. Weights by Max (J. Graphics Tools 4, 1999), exact on spheres however the facets are
  /// cut.
  void find_normals() {
    const TetComplex& mesh = patch.mesh;
    normal.assign(mesh.vertex_count(), {});
    std::vector<double> length(mesh.vertex_count(), 0);  // of the sum, were all facets parallel
    for (TetId t = 0; t < mesh.tet_slots(); ++t) {
      for (unsigned n = 0; mesh.alive(t) && n < 4; ++n) {
        if (mesh.material(t) > mesh.material_across(t, n)) {
          add_normals(mesh.nodes(t), n, length);
        }
      }
    }
    constexpr double kLeast = 0.6;  // tips, sharp edges and pinches have no normal
    for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
      const double norm = normal[v].norm();
      const bool known = !mesh.locked(v) && patch.sets[v].size == 2 && norm > kLeast * length[v];
      normal[v] = known ? normal[v] / norm : Vec3{};
    }
  }

  void add_normals(const std::array<VertexId, 4>& nodes, unsigned n, std::vector<double>& length) {
    std::array<Vec3, 3> side{};  // side c goes from corner c to the next
    for (unsigned c = 0; c < 3; ++c) {
      side[c] = patch.mesh.point(nodes[kTetFace[n][(c + 1) % 3]]) - patch.mesh.point(nodes[kTetFace[n][c]]);
    }
    const Vec3 vector = side[0].cross(side[1]);
    for (unsigned c = 0; c < 3; ++c) {
      const VertexId v = nodes[kTetFace[n][c]];
      const Vec3 weighted = vector / (side[c].squared_norm() * side[(c + 2) % 3].squared_norm());
      normal[v] += weighted;
      length[v] += weighted.norm();
    }
  }

  /// The planes in which the neighbours on the same interface or curve would have v, and its distance from
  /// them at x.
  void find_flat(VertexId v, const Vec3& x) {
    flat.clear();
    if (!normal.empty() && pairs.size() > 1) {
      find_straight(x);
    } else if (!normal.empty() && pairs.size() == 1 && normal[v].squared_norm() > 0) {
      find_planes_of_neighbours(v, x);
    }
  }

  void find_planes_of_neighbours(VertexId v, const Vec3& x) {
    for (const VertexId w : surface_neighbours()) {
      const Vec3 sum = normal[v] + normal[w];
      if (normal[w].squared_norm() > 0 && sum.squared_norm() > 1) {
        const Vec3 m = sum.normalized();
        flat.push_back({m, m.dot(x - patch.mesh.point(w))});
      }
    }
  }

  /// Where v is on a curve at which materials meet: two planes along the line that joins its neighbours on
  /// the curve, through its middle. A curve is as smooth as its vertices are near the middle of their
  /// neighbours.
  void find_straight(const Vec3& x) {
    const auto ends = ends_on_curve();
    if (!ends) {
      return;
    }
    const Vec3& p = patch.mesh.point((*ends)[0]);
    const Vec3& q = patch.mesh.point((*ends)[1]);
    const Vec3 along = (q - p).normalized();
    const int least = std::fabs(along.x) < std::fabs(along.y)
                          ? (std::fabs(along.x) < std::fabs(along.z) ? 0 : 2)
                          : (std::fabs(along.y) < std::fabs(along.z) ? 1 : 2);
    Vec3 axis;
    axis[least] = 1;
    const Vec3 first = along.cross(axis).normalized();
    for (const Vec3& across : {first, along.cross(first)}) {
      flat.push_back({across, across.dot(x - 0.5 * (p + q))});
    }
  }

  /// The two neighbours at edges where three facets meet or more; nothing where there are fewer or more of
  /// them.
  std::optional<std::array<VertexId, 2>> ends_on_curve() {
    cbc3d::surface_neighbours(patch.facets, beside);
    std::array<VertexId, 2> ends{};
    std::size_t count = 0;
    for (const SurfaceNeighbour& s : beside) {
      if (s.facets > 2 && count++ < 2) {
        ends[count - 1] = s.vertex;
      }
    }
    return count == 2 ? std::optional(ends) : std::nullopt;
  }

  [[nodiscard]] double deviation(const Vec3& x) const {
    double largest = 0;
    for (const auto& [inner, outer] : pairs) {
      largest = std::max(largest, patch.boundaries.distance(x, inner, outer).deviation_mm);
    }
    return largest;
  }

  /// True when x is within near_mm of its boundaries, or nearer (in the mean of squares) than the vertex was
  /// by the planes.
  [[nodiscard]] bool stays_near(const Vec3& x, double near_mm) const {
    double before = 0;
    for (const Plane& plane : planes) {
      before += plane.offset_mm * plane.offset_mm;
    }
    double after = 0;
    double largest = 0;
    for (const auto& [inner, outer] : pairs) {
      const double d = patch.boundaries.distance(x, inner, outer).deviation_mm;
      after += d * d;
      largest = std::max(largest, d);
    }
    return largest <= near_mm || after <= before;
  }

  /// Energy at x + step, or a negative number when a tet would turn over.
  [[nodiscard]] double energy(const Vec3& x, const Vec3& step, const Weights& weights) const {
    double sum = 0;
    const Vec3 at = x + step;
    for (const auto& face : link) {
      const double e = shape_energy(at, face[0], face[1], face[2]);
      if (e < 0) {
        return -1;
      }
      sum += e;
    }
    const auto add_planes = [&](const std::vector<Plane>& some, double weight) {
      for (const Plane& plane : some) {
        const double offset = plane.offset_mm + plane.normal.dot(step);
        sum += 0.5 * weight * offset * offset;
      }
    };
    add_planes(planes, weights.boundary);
    add_planes(flat, weights.flat);
    return sum;
  }

  /// Neighbours of v on boundaries; they may cover its samples in its place.
  [[nodiscard]] std::span<const VertexId> surface_neighbours() {
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

  /// Moves v when its samples stay covered.
  bool move(VertexId v, const Vec3& to) {
    if (patch.on_boundary(v)) {
      if (!patch.cover.can_release(v, &to, surface_neighbours(), patch.mesh, patch.sets)) {
        return false;
      }
      patch.cover.commit(v);
    }
    patch.mesh.move(v, to);
    return true;
  }

  bool is_far(VertexId v, double near_mm) { return load(v) && deviation(patch.mesh.point(v)) > near_mm; }

  bool relax(VertexId v, const RelaxOptions& options) {
    if (!load(v)) {
      return false;
    }
    const Vec3 x = patch.mesh.point(v);
    if (!pairs.empty() && !find_planes(x)) {
      return false;
    }
    find_flat(v, x);
    Step step = newton(v, x, options);
    if (step == Step::refused && !flat.empty()) {
      flat.clear();
      step = newton(v, x, options);
    }
    return step == Step::taken;
  }

  /// The cap of the thinnest material at the vertex that was loaded.
  [[nodiscard]] double smoothness_cap(const RelaxOptions& options) const {
    double cap = options.smoothness_cap_mm;
    for (const auto& [inner, outer] : pairs) {
      for (const MaterialId m : {inner, outer}) {
        cap = m < patch.smoothness_cap_mm.size() ? std::min(cap, patch.smoothness_cap_mm[m]) : cap;
      }
    }
    return cap;
  }

  [[nodiscard]] Weights weights_of(const RelaxOptions& options) const {
    const double weight = options.surface_weight / (patch.guards.scale_mm * patch.guards.scale_mm);
    if (flat.empty()) {
      return {weight, 0};
    }
    const auto in_a_direction = static_cast<double>(pairs.size() == 1 ? flat.size() : flat.size() / 2);
    return {(1 - options.smoothness) * weight, options.smoothness * weight / in_a_direction};
  }

  /// Takes the Newton step from x, if there is one; with the smoothness where `flat` has planes.
  Step newton(VertexId v, const Vec3& x, const RelaxOptions& options) {
    const Weights weights = weights_of(options);
    ShapeTerm sum;
    for (const auto& face : link) {
      if (!add_shape_term(x, face[0], face[1], face[2], sum)) {
        return Step::refused;
      }
    }
    for (const Plane& plane : planes) {
      add_plane_term(plane.normal, plane.offset_mm, weights.boundary, sum);
    }
    for (const Plane& plane : flat) {
      add_plane_term(plane.normal, plane.offset_mm, weights.flat, sum);
    }
    const double near_mm = flat.empty() ? patch.guards.deviation_mm : smoothness_cap(options);
    Vec3 step = newton_step(sum);
    const double length = step.norm();
    const double longest = options.max_step * std::sqrt(mean_squared_distance(link, x));
    if (!(length > options.skip_below_mm)) {
      return Step::none_needed;
    }
    if (length > longest) {
      step *= longest / length;
    }
    for (int attempt = 0; attempt < 5; ++attempt, step *= 0.5) {
      const double after = energy(x, step, weights);
      if (after >= 0 && after < sum.energy && stays_near(x + step, near_mm) && move(v, x + step)) {
        return Step::taken;
      }
    }
    return Step::refused;
  }

  bool optimize_angle(VertexId v, double goal) {
    if (!load(v)) {
      return false;
    }
    const Vec3 start = patch.mesh.point(v);
    const double h = std::sqrt(mean_squared_distance(link, start));
    double best = worst_quality(link, start, -1e300);
    if (best >= goal) {
      return false;
    }
    const double limit = std::max(patch.guards.deviation_mm, deviation(start));
    bool moved = false;
    for (double length = 0.3 * h; length > 0.004 * h; length *= 0.5) {
      for (int turn = 0; turn < 2 && best < goal && search_step(v, length, limit, best); ++turn) {
        moved = true;
      }
    }
    return moved;
  }

  /// Takes the first step of a length that lifts the worst angle.
  bool search_step(VertexId v, double length, double limit, double& best) {
    const Vec3 x = patch.mesh.point(v);
    const Vec3 up = steepest_ascent(link, x, length);
    for (const Vec3& direction : search_directions(up)) {
      const Vec3 to = x + length * direction;
      const double after = worst_quality(link, to, best);
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
  if (options.smoothness > 0) {
    mover.find_normals();
  }
  std::size_t moved = 0;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    moved += mover.relax(v, options) ? 1 : 0;
  }
  return moved;
}

std::size_t project_far_vertices(Patch& patch, const RelaxOptions& options) {
  VertexMover mover(patch);
  const double near_mm = options.smoothness > 0
                             ? std::max(patch.guards.deviation_mm, options.smoothness_cap_mm)
                             : patch.guards.deviation_mm;
  std::size_t moved = 0;
  std::vector<VertexId> around;
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    for (int turn = 0; turn < 4 && patch.on_boundary(v) && mover.is_far(v, near_mm); ++turn) {
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

std::size_t optimize_worst_angles(Patch& patch, double goal_quality) {
  VertexMover mover(patch);
  std::size_t moved = 0;
  for (TetId t = 0; t < patch.mesh.tet_slots(); ++t) {
    if (!patch.mesh.alive(t)) {
      continue;
    }
    for (std::size_t n = 0; n < 4 && patch.mesh.quality(t) < goal_quality; ++n) {
      moved += mover.optimize_angle(patch.mesh.nodes(t)[n], goal_quality) ? 1 : 0;
    }
  }
  return moved;
}

}  // namespace cbc3d
