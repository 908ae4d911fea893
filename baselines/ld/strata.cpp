#include "baselines/ld/strata.hpp"

#include <algorithm>
#include <vector>

namespace cbc3d::baselines::ld {
namespace {

/// The curves in which the interfaces meet a small sphere around a corner. Nodes are the six directions,
/// number 2 axis + 1 for the positive one; an arc joins two of them across the quarter of a face between
/// them.
class SphereCurves {
 public:
  explicit SphereCurves(const CellsAround& around) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t cell = 0; cell < 8; ++cell) {
        const std::size_t across = cell ^ (std::size_t{1} << axis);
        if (cell < across && around[cell] != around[across]) {
          const std::size_t u = (axis + 1) % 3;
          const std::size_t v = (axis + 2) % 3;
          join(2 * u + (cell >> u & 1U), 2 * v + (cell >> v & 1U));
        }
      }
    }
  }

  [[nodiscard]] int arcs() const { return arcs_; }
  [[nodiscard]] int degree(std::size_t node) const {
    return static_cast<int>(std::count(joined_[node].begin(), joined_[node].end(), true));
  }
  [[nodiscard]] std::vector<std::size_t> poles() const {
    std::vector<std::size_t> poles;
    for (std::size_t node = 0; node < 6; ++node) {
      if (degree(node) > 2) poles.push_back(node);
    }
    return poles;
  }
  [[nodiscard]] bool is_one_closed_curve() const {
    for (std::size_t node = 0; node < 6; ++node) {
      if (degree(node) == 0) continue;
      for (std::size_t next = 0; next < 6; ++next) {
        if (joined_[node][next]) return walk(node, next, node).steps == arcs_;
      }
    }
    return false;
  }
  /// True when all there is are arcs from one node to the other.
  [[nodiscard]] bool is_suspension(std::size_t from, std::size_t to) const {
    int steps = 0;
    for (std::size_t next = 0; next < 6; ++next) {
      if (!joined_[from][next]) continue;
      const Walk arc = walk(from, next, to);
      if (arc.end != to) return false;
      steps += arc.steps;
    }
    return steps == arcs_;
  }

 private:
  struct Walk {
    int steps;
    std::size_t end;
  };

  void join(std::size_t a, std::size_t b) {
    joined_[a][b] = joined_[b][a] = true;
    ++arcs_;
  }

  // Goes on through nodes of degree two until `stop` or a node of another degree.
  [[nodiscard]] Walk walk(std::size_t from, std::size_t at, std::size_t stop) const {
    int steps = 1;
    while (at != stop && degree(at) == 2) {
      std::size_t next = 0;
      while (!joined_[at][next] || next == from) ++next;
      from = at;
      at = next;
      ++steps;
    }
    return {steps, at};
  }

  std::array<std::array<bool, 6>, 6> joined_{};
  int arcs_ = 0;
};

}  // namespace

Stratum stratum_of(const CellsAround& around) {
  const SphereCurves curves(around);
  if (curves.arcs() == 0) return Stratum::volume;
  const std::vector<std::size_t> poles = curves.poles();
  if (poles.empty()) return curves.is_one_closed_curve() ? Stratum::sheet : Stratum::point;
  const bool is_line = poles.size() == 2 && curves.degree(poles[0]) == curves.degree(poles[1]) &&
                       curves.is_suspension(poles[0], poles[1]);
  return is_line ? Stratum::line : Stratum::point;
}

std::uint8_t normal_axes_of(const CellsAround& around) {
  std::uint8_t axes = 0;
  for (std::size_t cell = 0; cell < 8; ++cell) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (around[cell] != around[cell ^ (std::size_t{1} << axis)])
        axes |= static_cast<std::uint8_t>(1U << axis);
    }
  }
  return axes;
}

}  // namespace cbc3d::baselines::ld
