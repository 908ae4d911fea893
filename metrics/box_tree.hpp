// Nearest-primitive queries over a tree of bounding boxes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "mesher/core/vec3.hpp"

namespace cbc3d::metrics {

struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -low;

  void add(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  /// Touching boxes overlap.
  [[nodiscard]] bool overlaps(const Box& o) const {
    return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
           low.z <= o.high.z && o.low.z <= high.z;
  }
  [[nodiscard]] double squared_distance(const Vec3& p) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = std::max({low[axis] - p[axis], p[axis] - high[axis], 0.0});
      sum += d * d;
    }
    return sum;
  }
};

/// `Primitive` has `void add_to(Box&) const` (its bounds) and, for queries by distance,
/// `double squared_distance(const Vec3&) const`.
/// Nodes lie in heap order; every level halves its range, so ranges need no storing.
template <class Primitive>
class BoxTree {
 public:
  explicit BoxTree(std::vector<Primitive> primitives) : primitives_(std::move(primitives)) {
    std::size_t leaves = 1;
    while (leaves * kLeafSize < primitives_.size()) {
      leaves *= 2;
    }
    nodes_.resize(2 * leaves - 1);
    first_leaf_ = leaves - 1;
#pragma omp parallel if (primitives_.size() > kTaskSize)
#pragma omp single
    build(0, 0, primitives_.size());
  }

  [[nodiscard]] bool empty() const {
    return primitives_.empty();
  }

  [[nodiscard]] std::size_t size() const {
    return primitives_.size();
  }

  [[nodiscard]] const Primitive& primitive(std::size_t index) const {
    return primitives_[index];
  }

  /// Squared distance to the nearest primitive (infinity without one), and which one it is: of several the
  /// one of the lowest index. `hint`, an index this returned for a nearby point, only makes it faster.
  struct Nearest {
    double squared;
    std::size_t index;
  };
  [[nodiscard]] Nearest nearest(const Vec3& p, std::size_t hint = 0) const {
    if (empty()) {
      return {std::numeric_limits<double>::infinity(), 0};
    }
    Nearest best{primitives_[hint].squared_distance(p), hint};
    std::array<Pending, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {nodes_[0].squared_distance(p), 0, 0, primitives_.size()};
    while (depth > 0) {
      const Pending at = stack[--depth];
      if (at.squared > best.squared) {
        continue;
      }
      if (at.node >= first_leaf_) {
        search_leaf(p, at, best);
        continue;
      }
      const std::size_t middle = at.begin + (at.end - at.begin) / 2, child = 2 * at.node + 1;
      Pending near{nodes_[child].squared_distance(p), child, at.begin, middle};
      Pending far{nodes_[child + 1].squared_distance(p), child + 1, middle, at.end};
      if (far.squared < near.squared) {
        std::swap(near, far);
      }
      stack[depth++] = far;
      stack[depth++] = near;
    }
    return best;
  }

  /// True when a primitive within sqrt(squared_radius) of p satisfies accept(primitive).
  template <class Accept>
  [[nodiscard]] bool any_within(const Vec3& p, double squared_radius, const Accept& accept) const {
    std::array<Pending, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, 0, 0, primitives_.size()};
    while (depth > 0) {
      const Pending at = stack[--depth];
      if (nodes_[at.node].squared_distance(p) > squared_radius) {
        continue;
      }
      if (at.node >= first_leaf_) {
        for (std::size_t i = at.begin; i < at.end; ++i) {
          if (primitives_[i].squared_distance(p) <= squared_radius && accept(primitives_[i])) {
            return true;
          }
        }
        continue;
      }
      const std::size_t middle = at.begin + (at.end - at.begin) / 2;
      stack[depth++] = {0, 2 * at.node + 2, middle, at.end};
      stack[depth++] = {0, 2 * at.node + 1, at.begin, middle};
    }
    return false;
  }

  /// Calls visit(primitive) for each primitive of an index from `first` on whose box overlaps `box`, in
  /// order.
  template <class Visit>
  void for_each_overlapping(const Box& box, std::size_t first, const Visit& visit) const {
    std::array<Pending, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, 0, 0, primitives_.size()};
    while (depth > 0) {
      const Pending at = stack[--depth];
      if (at.end <= first || !nodes_[at.node].overlaps(box)) {
        continue;
      }
      if (at.node >= first_leaf_) {
        for (std::size_t i = std::max(at.begin, first); i < at.end; ++i) {
          Box own;
          primitives_[i].add_to(own);
          if (own.overlaps(box)) {
            visit(primitives_[i]);
          }
        }
        continue;
      }
      const std::size_t middle = at.begin + (at.end - at.begin) / 2;
      stack[depth++] = {0, 2 * at.node + 2, middle, at.end};
      stack[depth++] = {0, 2 * at.node + 1, at.begin, middle};
    }
  }

 private:
  static constexpr std::size_t kLeafSize = 4;
  static constexpr std::size_t kTaskSize = 32768;
  struct Pending {
    double squared;
    std::size_t node, begin, end;
  };

  void search_leaf(const Vec3& p, const Pending& leaf, Nearest& best) const {
    for (std::size_t i = leaf.begin; i < leaf.end; ++i) {
      const double squared = primitives_[i].squared_distance(p);
      if (squared < best.squared || (squared == best.squared && i < best.index)) {
        best = {squared, i};
      }
    }
  }

  static Vec3 middle_of(const Primitive& primitive) {
    Box box;
    primitive.add_to(box);
    return box.low + box.high;
  }

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    Box& box = nodes_[node];
    for (std::size_t i = begin; i < end; ++i) {
      primitives_[i].add_to(box);
    }
    if (node >= first_leaf_) {
      return;
    }
    const Vec3 extent = box.high - box.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const auto at = [this](std::size_t i) { return primitives_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(at(begin), at(middle), at(end), [axis](const Primitive& a, const Primitive& b) {
      return middle_of(a)[axis] < middle_of(b)[axis];
    });
#pragma omp task if (end - begin > kTaskSize)
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
#pragma omp taskwait
  }

  std::vector<Primitive> primitives_;
  std::vector<Box> nodes_;
  std::size_t first_leaf_ = 0;
};

/// A triangle; may be degenerate.
struct Triangle {
  Vec3 a, b, c;

  void add_to(Box& box) const {
    box.add(a);
    box.add(b);
    box.add(c);
  }
  [[nodiscard]] double squared_distance(const Vec3& p) const;
};

/// A box aligned with the axes, a face of a voxel for one.
struct AlignedBox {
  Box box;

  void add_to(Box& to) const {
    to.add(box.low);
    to.add(box.high);
  }
  [[nodiscard]] double squared_distance(const Vec3& p) const { return box.squared_distance(p); }
};

}  // namespace cbc3d::metrics
