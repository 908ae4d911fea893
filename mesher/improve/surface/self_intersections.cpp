#include "mesher/improve/surface/self_intersections.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mesher/improve/local/mesh_star.hpp"

namespace cbc3d {
namespace {

using Facet = std::array<VertexId, 3>;

constexpr double kLeastGap = 1e-6;  // between facets at an edge, radians

struct OuterSurface {
  std::vector<Facet> facets;  // counter-clockwise seen from outside
  std::vector<Vec3> normals;  // of vertices, sum of their facets' area vectors
  std::vector<Facet> inner;   // between materials, those at vertices of the outer surface
};

/// Adds the facets that the outer surface may pass through where it is folded over at a vertex.
void add_inner_facets(const MaterialMesh& mesh, const TetNeighbours& neighbours, OuterSurface& surface) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId other = neighbours[t][n];
      if (other != kNoTet && mesh.materials[t] > mesh.materials[other]) {
        const auto& nodes = mesh.tets[t];
        const Facet f = {nodes[kTetFace[n][0]], nodes[kTetFace[n][1]], nodes[kTetFace[n][2]]};
        if (std::any_of(f.begin(), f.end(),
                        [&](VertexId v) { return surface.normals[v].squared_norm() > 0; })) {
          surface.inner.push_back(f);
        }
      }
    }
  }
}

OuterSurface outer_surface(const MaterialMesh& mesh) {
  OuterSurface surface;
  surface.normals.resize(mesh.points.size());
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (neighbours[t][n] == kNoTet) {
        const auto& nodes = mesh.tets[t];
        const Facet f = {nodes[kTetFace[n][0]], nodes[kTetFace[n][1]], nodes[kTetFace[n][2]]};
        const Vec3 normal =
            (mesh.points[f[1]] - mesh.points[f[0]]).cross(mesh.points[f[2]] - mesh.points[f[0]]);
        for (const VertexId v : f) {
          surface.normals[v] += normal;
        }
        surface.facets.push_back(f);
      }
    }
  }
  add_inner_facets(mesh, neighbours, surface);
  return surface;
}

/// True when segment p, q, in the plane of triangle a, b, c, has a part inside it.
bool lies_in(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 up = (b - a).cross(c - a);
  const double tiny = 1e-9 * up.norm() * ((b - a).norm() + (c - a).norm());
  const std::array<std::array<Vec3, 2>, 3> sides = {{{a, b}, {b, c}, {c, a}}};
  for (const auto& [from, to] : sides) {
    const Vec3 inwards = up.cross(to - from);
    if (inwards.dot(p - from) <= tiny * (to - from).norm() &&
        inwards.dot(q - from) <= tiny * (to - from).norm()) {
      return false;
    }
  }
  const Vec3 across = up.cross(q - p);
  const std::array<double, 3> at = {across.dot(a - p), across.dot(b - p), across.dot(c - p)};
  const double leeway = tiny * (q - p).norm();
  return !std::all_of(at.begin(), at.end(), [&](double d) { return d >= -leeway; }) &&
         !std::all_of(at.begin(), at.end(), [&](double d) { return d <= leeway; });
}

/// True when segment p, q meets triangle a, b, c; touching within rounding counts too, except in a common
/// plane.
bool meets(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double scale = (b - a).norm() * (c - a).norm() * (q - p).norm();
  const double tiny = 1e-9 * scale;
  const double side_p = six_volumes(a, b, c, p);
  const double side_q = six_volumes(a, b, c, q);
  if ((side_p > tiny && side_q > tiny) || (side_p < -tiny && side_q < -tiny)) {
    return false;
  }
  if (std::fabs(side_p) <= tiny && std::fabs(side_q) <= tiny) {
    return lies_in(p, q, a, b, c);
  }
  const double u = six_volumes(p, q, a, b);
  const double v = six_volumes(p, q, b, c);
  const double w = six_volumes(p, q, c, a);
  return (u >= -tiny && v >= -tiny && w >= -tiny) || (u <= tiny && v <= tiny && w <= tiny);
}

bool has(const Facet& f, VertexId v) {
  return f[0] == v || f[1] == v || f[2] == v;
}

/// A side of f meets facet g; sides that end in a vertex of g only touch it there.
bool sides_meet(const std::vector<Vec3>& points, const Facet& f, const Facet& g) {
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId p = f[i];
    const VertexId q = f[(i + 1) % 3];
    if (!has(g, p) && !has(g, q) && meets(points[p], points[q], points[g[0]], points[g[1]], points[g[2]])) {
      return true;
    }
  }
  return false;
}

class IntersectionFinder {
 public:
  IntersectionFinder(const std::vector<Vec3>& points, const std::vector<Facet>& facets)
      : points_(points), facets_(facets) {
    double sum = 0;
    for (const Facet& f : facets) {
      sum += (points[f[1]] - points[f[0]]).norm();
    }
    cell_mm_ = facets.empty() ? 1 : 2 * sum / static_cast<double>(facets.size());
    boxes_.resize(facets.size());
    fill_buckets();
  }

  [[nodiscard]] std::vector<std::array<std::uint32_t, 2>> find() const {
    std::vector<std::vector<std::uint32_t>> partners(facets_.size());
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      partners[f] = partners_of(static_cast<std::uint32_t>(f));
    }
    std::vector<std::array<std::uint32_t, 2>> pairs;
    for (std::uint32_t f = 0; f < partners.size(); ++f) {
      for (const std::uint32_t g : partners[f]) {
        pairs.push_back({f, g});
      }
    }
    return pairs;
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t facet;
  };

  [[nodiscard]] std::size_t bucket_of(std::uint64_t key) const {
    return (key * 0x9E3779B97F4A7C15ULL >> 32U) & (first_.size() - 2);
  }

  /// Sorts the cells into buckets by a hash of their key. The order within a bucket does not matter.
  void fill_buckets() {
    std::size_t buckets = 2;
    while (buckets < 4 * facets_.size()) {
      buckets *= 2;
    }
    first_.assign(buckets + 1, 0);
    const auto one_more = [](std::uint32_t& count) {
      return std::atomic_ref<std::uint32_t>(count).fetch_add(1, std::memory_order_relaxed);
    };
#pragma omp parallel for schedule(static)
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      boxes_[f] = box_of(facets_[f]);
      for_each_cell(static_cast<std::uint32_t>(f),
                    [&](std::uint64_t key) { one_more(first_[bucket_of(key)]); });
    }
    std::exclusive_scan(first_.begin(), first_.end(), first_.begin(), 0U);
    entries_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
#pragma omp parallel for schedule(static)
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      for_each_cell(static_cast<std::uint32_t>(f), [&](std::uint64_t key) {
        entries_[one_more(next[bucket_of(key)])] = {key, static_cast<std::uint32_t>(f)};
      });
    }
  }

  struct Box {
    Vec3 low, high;
    [[nodiscard]] bool meets(const Box& other, double leeway) const {
      return low.x <= other.high.x + leeway && other.low.x <= high.x + leeway &&
             low.y <= other.high.y + leeway && other.low.y <= high.y + leeway &&
             low.z <= other.high.z + leeway && other.low.z <= high.z + leeway;
    }
  };
  [[nodiscard]] Box box_of(const Facet& f) const {
    Box box{points_[f[0]], points_[f[0]]};
    for (const VertexId v : f) {
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], points_[v][axis]);
        box.high[axis] = std::max(box.high[axis], points_[v][axis]);
      }
    }
    return box;
  }

  template <typename F>
  void for_each_cell(std::uint32_t facet, const F& f) const {
    Index3 low;
    Index3 high;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, most] =
          std::minmax({points_[facets_[facet][0]][axis], points_[facets_[facet][1]][axis],
                       points_[facets_[facet][2]][axis]});
      low[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(least / cell_mm_));
      high[static_cast<std::size_t>(axis)] = static_cast<int>(std::floor(most / cell_mm_));
    }
    for (int k = low[2]; k <= high[2]; ++k) {
      for (int j = low[1]; j <= high[1]; ++j) {
        for (int i = low[0]; i <= high[0]; ++i) {
          constexpr int kShift = 1 << 20;
          f((static_cast<std::uint64_t>(k + kShift) << 42) | (static_cast<std::uint64_t>(j + kShift) << 21) |
            static_cast<std::uint64_t>(i + kShift));
        }
      }
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> partners_of(std::uint32_t f) const {
    std::vector<std::uint32_t> near;
    for_each_cell(f, [&](std::uint64_t key) {
      const std::size_t bucket = bucket_of(key);
      for (std::uint32_t e = first_[bucket]; e < first_[bucket + 1]; ++e) {
        const Entry& entry = entries_[e];
        if (entry.facet > f && entry.key == key && boxes_[f].meets(boxes_[entry.facet], 1e-6 * cell_mm_)) {
          near.push_back(entry.facet);
        }
      }
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    std::erase_if(near, [&](std::uint32_t g) { return !facets_intersect(points_, facets_[f], facets_[g]); });
    return near;
  }

  const std::vector<Vec3>& points_;
  const std::vector<Facet>& facets_;
  double cell_mm_ = 1;
  std::vector<Box> boxes_;            // of the facets
  std::vector<std::uint32_t> first_;  // entry of every bucket, whose number is a power of two
  std::vector<Entry> entries_;
};

/// Moves single vertices of a mesh inwards while its tets stay.
class Retreat {
 public:
  Retreat(MaterialMesh& mesh, const SurfaceCover& cover, const SeparationOptions& options)
      : mesh_(mesh),
        cover_(cover),
        options_(options),
        around_(tets_of_vertices(mesh.tets, mesh.points.size())) {}

  [[nodiscard]] const VertexCells& around() const { return around_; }

  bool move(VertexId v, const Vec3& inwards) {
    const Vec3 from = mesh_.points[v];
    const double floor = std::min(options_.goal_quality, worst_at(v));
    for (const double share : {1.0, 0.5, 0.25}) {
      mesh_.points[v] = from + share * options_.step_mm * inwards;
      if (cover_.may_move(v, from, mesh_.points[v]) && worst_at(v) >= floor) {
        return true;
      }
    }
    mesh_.points[v] = from;
    return false;
  }

 private:
  [[nodiscard]] double worst_at(VertexId v) const { return worst_quality(mesh_, around_.of(v)); }

  MaterialMesh& mesh_;
  const SurfaceCover& cover_;
  const SeparationOptions& options_;
  VertexCells around_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 2>> intersecting_facets(
    const std::vector<Vec3>& points, const std::vector<std::array<VertexId, 3>>& facets) {
  return IntersectionFinder(points, facets).find();
}

bool facets_intersect(const std::vector<Vec3>& points, const Facet& f, const Facet& g) {
  const auto shared = std::count_if(f.begin(), f.end(), [&](VertexId v) { return has(g, v); });
  return shared < 2 && (sides_meet(points, f, g) || sides_meet(points, g, f));
}

namespace {

/// True when x, seen along edge a, b, lies between c and d.
bool lies_between(const std::vector<Vec3>& points, VertexId a, VertexId b, VertexId c, VertexId d,
                  VertexId x) {
  const auto same_side = [&](VertexId with, VertexId of) {
    const double side = six_volumes(points[a], points[b], points[with], points[x]);
    const double side_of = six_volumes(points[a], points[b], points[with], points[of]);
    return side * side_of > 1e-9 * side_of * side_of;
  };
  return x != c && x != d && same_side(c, d) && same_side(d, c);
}

VertexId other_than(const Facet& f, VertexId a, VertexId b) {
  return f[0] != a && f[0] != b ? f[0] : f[1] != a && f[1] != b ? f[1] : f[2];
}

}  // namespace

bool facets_fold(const std::vector<Vec3>& points, const Facet& f, VertexId behind_f, const Facet& g,
                 VertexId behind_g) {
  for (std::size_t i = 0; i < 3; ++i) {
    const VertexId a = f[i];
    const VertexId b = f[(i + 1) % 3];
    if (has(g, a) && has(g, b)) {
      const VertexId c = other_than(f, a, b);
      const VertexId d = other_than(g, a, b);
      return c != d &&
             (lies_between(points, a, b, c, behind_f, d) || lies_between(points, a, b, d, behind_g, c));
    }
  }
  return false;
}

namespace {

/// The sum of the dihedral angles of the tets at an edge.
double angle_around(const MaterialMesh& mesh, const VertexCells& around, VertexId a, VertexId b) {
  const Vec3 along = (mesh.points[b] - mesh.points[a]).normalized();
  double sum = 0;
  for (const TetId t : around.of(a)) {
    const auto& nodes = mesh.tets[t];
    if (std::find(nodes.begin(), nodes.end(), b) == nodes.end()) {
      continue;
    }
    std::array<Vec3, 2> out{};
    std::size_t count = 0;
    for (const VertexId v : nodes) {
      if (v != a && v != b) {
        const Vec3 to = mesh.points[v] - mesh.points[a];
        out[count++] = to - along.dot(to) * along;
      }
    }
    sum += std::atan2(out[0].cross(out[1]).norm(), out[0].dot(out[1]));
  }
  return sum;
}

/// Pairs of facets with a common edge around which the tets fill more than a full turn: a gap turned inside
/// out.
std::vector<std::array<std::uint32_t, 2>> overfull_pairs(const MaterialMesh& mesh, const VertexCells& around,
                                                         const OuterSurface& surface) {
  struct Side {
    std::array<VertexId, 2> ends;
    std::uint32_t facet;
  };
  std::vector<Side> sides;
  sides.reserve(3 * surface.facets.size());
  for (std::uint32_t f = 0; f < surface.facets.size(); ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(surface.facets[f][i], surface.facets[f][(i + 1) % 3]);
      sides.push_back({{low, high}, f});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.ends != b.ends ? a.ends < b.ends : a.facet < b.facet;
  });
  const auto normal = [&](std::uint32_t facet) {
    const Facet& f = surface.facets[facet];
    return (mesh.points[f[1]] - mesh.points[f[0]]).cross(mesh.points[f[2]] - mesh.points[f[0]]).normalized();
  };
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const auto& [ends, f] = sides[i];
    const bool back_to_back = ends == sides[i + 1].ends && normal(f).dot(normal(sides[i + 1].facet)) < -0.1;
    if (back_to_back && angle_around(mesh, around, ends[0], ends[1]) > 2 * std::numbers::pi - kLeastGap) {
      pairs.push_back({f, sides[i + 1].facet});
    }
  }
  return pairs;
}

}  // namespace

std::size_t count_self_intersections(const MaterialMesh& mesh, const std::vector<MaterialId>& label_of) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId across = neighbours[t][n];
      const bool parts =
          across == kNoTet || (t < across && label_of[mesh.materials[t]] != label_of[mesh.materials[across]]);
      if (parts) {
        const auto& nodes = mesh.tets[t];
        facets.push_back({nodes[kTetFace[n][0]], nodes[kTetFace[n][1]], nodes[kTetFace[n][2]]});
      }
    }
  }
  return intersecting_facets(mesh.points, facets).size();
}

std::size_t separate_self_intersections(MaterialMesh& mesh, const SurfaceCover& cover,
                                        const SeparationOptions& options) {
  std::vector<std::array<std::uint32_t, 2>> pairs;
  Retreat retreat(mesh, cover, options);
  for (int round = 0;; ++round) {
    const OuterSurface surface = outer_surface(mesh);
    std::vector<Facet> facets = surface.facets;
    facets.insert(facets.end(), surface.inner.begin(), surface.inner.end());
    pairs = intersecting_facets(mesh.points, facets);
    const auto overfull = overfull_pairs(mesh, retreat.around(), surface);
    pairs.insert(pairs.end(), overfull.begin(), overfull.end());
    if (pairs.empty() || round == options.rounds) {
      return pairs.size();
    }
    std::vector<VertexId> vertices;
    for (const auto& pair : pairs) {
      for (const std::uint32_t f : pair) {
        vertices.insert(vertices.end(), facets[f].begin(), facets[f].end());
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::size_t moved = 0;
    for (const VertexId v : vertices) {
      if (surface.normals[v].squared_norm() == 0) {
        continue;  // inside
      }
      moved += retreat.move(v, -1 * surface.normals[v].normalized()) ? 1 : 0;
    }
    if (moved == 0) {
      return pairs.size();
    }
  }
}

}  // namespace cbc3d
