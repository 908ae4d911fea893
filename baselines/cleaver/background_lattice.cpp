#include "baselines/cleaver/background_lattice.hpp"

#include <algorithm>
#include <array>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// A vertex by its coordinates in half grid cells, z first, so that keys sort by layers.
using Key = std::uint64_t;
using KeyTet = std::array<Key, 4>;

Key key_of(const Index3& p) {
  return (static_cast<Key>(p[2]) << 42U) | (static_cast<Key>(p[1]) << 21U) | static_cast<Key>(p[0]);
}
Index3 place_of(Key key) {
  constexpr Key kMask = (Key{1} << 21U) - 1;
  return {static_cast<int>(key & kMask), static_cast<int>((key >> 21U) & kMask),
          static_cast<int>(key >> 42U)};
}
Index3 plus(Index3 p, std::size_t axis, int step) {
  p[axis] += step;
  return p;
}

// The tets of one leaf: those within it, and those that it shares with a leaf of its size on its upper side.
class LeafTets {
 public:
  LeafTets(const Octree& octree, const Leaf& leaf, std::vector<KeyTet>& tets)
      : octree_(octree), leaf_(leaf), edge_(2 << leaf.level), tets_(tets) {
    for (std::size_t a = 0; a < 3; ++a) low_[a] = 2 * leaf.cell[a];
    centre_ = {low_[0] + edge_ / 2, low_[1] + edge_ / 2, low_[2] + edge_ / 2};
  }

  void append() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      append_side(axis, false);
      append_side(axis, true);
    }
  }

 private:
  void append_side(std::size_t axis, bool upper) {
    Index3 beyond = leaf_.cell;
    beyond[axis] += upper ? 1 << leaf_.level : -1;
    const int limit = octree_.grid().cells[axis];
    if (beyond[axis] < 0 || beyond[axis] >= limit) return;  // all is background there
    Index3 corner = low_;
    if (upper) corner[axis] += edge_;
    // A neighbour of the same size holds the cell beside the corner; a finer one may not, yet is as deep
    // there.
    const int level = octree_.level_at(beyond);
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (level < leaf_.level) {
      append_eighths(corner, u, v);
    } else if (level > leaf_.level) {
      append_halves(corner, axis, u, v, level);
    } else if (upper) {
      append_around_axis(corner, axis, u, v);
    }
  }

  // The neighbours are finer: the pyramid under the face in eight, about the face's centre.
  void append_eighths(const Index3& corner, std::size_t u, std::size_t v) {
    const int half = edge_ / 2;
    const Index3 middle = plus(plus(corner, u, half), v, half);
    for (const auto& [a, b] : face_edges(corner, u, v)) {
      const Index3 between = midpoint(a, b);
      append_tet(centre_, a, between, middle);
      append_tet(centre_, between, b, middle);
    }
  }

  // The neighbour is coarser: the pyramid in two, by the diagonal that ends at the centre of its face.
  void append_halves(const Index3& corner, std::size_t axis, std::size_t u, std::size_t v, int level) {
    Index3 middle = corner;
    for (const std::size_t a : {u, v}) {
      const int coarse = 2 << level;
      middle[a] = corner[a] / coarse * coarse + coarse / 2;
    }
    middle[axis] = corner[axis];
    Index3 opposite = corner;
    for (const std::size_t a : {u, v}) opposite[a] = middle[a] == corner[a] ? corner[a] + edge_ : corner[a];
    const Index3 third = [&] {
      Index3 p = middle;
      p[u] = opposite[u];
      return p;
    }();
    const Index3 fourth = [&] {
      Index3 p = middle;
      p[v] = opposite[v];
      return p;
    }();
    append_tet(centre_, middle, third, opposite);
    append_tet(centre_, middle, opposite, fourth);
  }

  // The neighbour is as large: four tets around the line between the centres, each in two where a finer leaf
  // has a vertex in the middle of its edge.
  void append_around_axis(const Index3& corner, std::size_t axis, std::size_t u, std::size_t v) {
    const Index3 other = plus(centre_, axis, edge_);
    for (const auto& [a, b] : face_edges(corner, u, v)) {
      if (is_divided(a, b)) {
        const Index3 between = midpoint(a, b);
        append_tet(centre_, a, between, other);
        append_tet(centre_, between, b, other);
      } else {
        append_tet(centre_, a, b, other);
      }
    }
  }

  [[nodiscard]] std::array<std::array<Index3, 2>, 4> face_edges(const Index3& corner, std::size_t u,
                                                                std::size_t v) const {
    const Index3 a = corner, b = plus(corner, u, edge_), d = plus(corner, v, edge_), c = plus(b, v, edge_);
    return {{{a, b}, {b, c}, {c, d}, {d, a}}};
  }
  static Index3 midpoint(const Index3& a, const Index3& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  }

  // Whether one of the four leaves around an edge of this leaf is finer.
  [[nodiscard]] bool is_divided(const Index3& a, const Index3& b) const {
    const std::size_t along = a[0] != b[0] ? 0 : a[1] != b[1] ? 1 : 2;
    const std::size_t u = (along + 1) % 3, v = (along + 2) % 3;
    Index3 cell{};
    for (std::size_t n = 0; n < 3; ++n) cell[n] = std::min(a[n], b[n]) / 2;
    for (const int du : {-1, 0}) {
      for (const int dv : {-1, 0}) {
        if (octree_.level_at(plus(plus(cell, u, du), v, dv)) < leaf_.level) return true;
      }
    }
    return false;
  }

  void append_tet(const Index3& a, const Index3& b, const Index3& c, const Index3& d) {
    const auto vector = [&](const Index3& p) {
      return Vec3{static_cast<double>(p[0] - a[0]), static_cast<double>(p[1] - a[1]),
                  static_cast<double>(p[2] - a[2])};
    };
    const bool positive = vector(b).cross(vector(c)).dot(vector(d)) > 0;
    tets_.push_back({key_of(a), key_of(positive ? b : c), key_of(positive ? c : b), key_of(d)});
  }

  const Octree& octree_;
  Leaf leaf_;
  int edge_;  // half grid cells
  Index3 low_{}, centre_{};
  std::vector<KeyTet>& tets_;
};

// Some leaves' tets with their vertices' keys, ascending.
struct Part {
  std::vector<KeyTet> tets;
  std::vector<Key> keys;
};

Part part_of(const Octree& octree, const std::vector<Leaf>& leaves, std::size_t begin, std::size_t end) {
  Part part;
  for (std::size_t n = begin; n < end; ++n) LeafTets(octree, leaves[n], part.tets).append();
  part.keys.reserve(4 * part.tets.size());
  for (const KeyTet& tet : part.tets) part.keys.insert(part.keys.end(), tet.begin(), tet.end());
  std::sort(part.keys.begin(), part.keys.end());
  part.keys.erase(std::unique(part.keys.begin(), part.keys.end()), part.keys.end());
  return part;
}

std::size_t rank_of(const std::vector<Key>& keys, Key key) {
  return static_cast<std::size_t>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
}

std::vector<Key> all_keys(const std::vector<Part>& parts) {
  std::vector<std::vector<Key>> merged(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) merged[p] = parts[p].keys;
  // Neighbours are merged pairwise, so that no key is moved more often than there are halvings.
  for (std::size_t step = 1; step < merged.size(); step *= 2) {
#pragma omp parallel for schedule(dynamic)
    for (std::size_t p = 0; p < merged.size(); p += 2 * step) {
      if (p + step >= merged.size()) continue;
      std::vector<Key> both;
      both.reserve(merged[p].size() + merged[p + step].size());
      std::set_union(merged[p].begin(), merged[p].end(), merged[p + step].begin(), merged[p + step].end(),
                     std::back_inserter(both));
      merged[p] = std::move(both);
      merged[p + step] = {};
    }
  }
  return merged.empty() ? std::vector<Key>{} : std::move(merged.front());
}

// The parts of all leaves, which threads make each by itself.
std::vector<Part> parts_of(const Octree& octree, const std::vector<Leaf>& leaves) {
  constexpr std::size_t kLeavesOfPart = 4096;
  std::vector<Part> parts((leaves.size() + kLeavesOfPart - 1) / kLeavesOfPart);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p)
    parts[p] = part_of(octree, leaves, p * kLeavesOfPart, std::min(leaves.size(), (p + 1) * kLeavesOfPart));
  return parts;
}

std::vector<Vec3> points_of(const LatticeGrid& grid, const std::vector<Key>& keys) {
  std::vector<Vec3> points(keys.size());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < keys.size(); ++n) {
    const Index3 p = place_of(keys[n]);
    points[n] = grid.place(0.5 * p[0], 0.5 * p[1], 0.5 * p[2]);
  }
  return points;
}

// Writes the tets of a part with the lattice's numbers of their vertices.
void number_tets(const Part& part, const std::vector<Key>& keys, TetNodes::value_type* tets) {
  std::vector<VertexId> ids(part.keys.size());
  for (std::size_t n = 0; n < ids.size(); ++n) ids[n] = static_cast<VertexId>(rank_of(keys, part.keys[n]));
  for (std::size_t t = 0; t < part.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) tets[t][n] = ids[rank_of(part.keys, part.tets[t][n])];
  }
}

}  // namespace

Lattice background_lattice(const Octree& octree, const std::vector<Leaf>& leaves) {
  std::vector<Part> parts = parts_of(octree, leaves);
  const std::vector<Key> keys = all_keys(parts);
  std::vector<std::size_t> begins(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p) begins[p + 1] = begins[p] + parts[p].tets.size();
  if (keys.size() >= (std::size_t{1} << 31U) || begins.back() >= (std::size_t{1} << 31U))
    throw JobError("the background lattice has more than two thousand million cells: lower --sampling-rate");
  Lattice lattice;
  lattice.points = points_of(octree.grid(), keys);
  lattice.tets.resize(begins.back());
#pragma omp parallel for schedule(dynamic)
  for (std::size_t p = 0; p < parts.size(); ++p) {
    number_tets(parts[p], keys, lattice.tets.data() + begins[p]);
    parts[p] = {};
  }
  return lattice;
}

std::vector<VertexId> keep_tets(Lattice& lattice, const std::vector<char>& keep) {
  std::size_t kept = 0;
  std::vector<VertexId> number(lattice.points.size(), kNoVertex);
  for (std::size_t t = 0; t < lattice.tets.size(); ++t) {
    if (keep[t] == 0) continue;
    for (const VertexId v : lattice.tets[t]) number[v] = 0;
    lattice.tets[kept++] = lattice.tets[t];
  }
  lattice.tets.resize(kept);
  std::vector<VertexId> former;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNoVertex) continue;
    number[v] = static_cast<VertexId>(former.size());
    lattice.points[former.size()] = lattice.points[v];
    former.push_back(static_cast<VertexId>(v));
  }
  lattice.points.resize(former.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < kept; ++t) {
    for (VertexId& v : lattice.tets[t]) v = number[v];
  }
  return former;
}

}  // namespace cbc3d::baselines::cleaver
