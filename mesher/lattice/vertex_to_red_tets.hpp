// Which red tets a split at a vertex may concern.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/lattice/lattice.hpp"

namespace cbc3d {

/// For every vertex the red tets that it is a node of, or the middle of a split edge: rows of what was there
/// when this was built, and lists of what came since. What is no longer so stays in them.
class VertexToRedTets {
 public:
  [[nodiscard]] bool is_built() const { return !first_.empty(); }
  void build(const Lattice& lattice);
  void drop() { *this = {}; }

  /// A red tet is new, or has other split edges than before.
  void note_changed(const Lattice& lattice, std::size_t red);
  /// True when most of what is known came since this was built.
  [[nodiscard]] bool is_stale() const { return later_.size() > reds_.size(); }

  /// Calls f(red) for all red tets of the vertex, and for others; for some more than once.
  template <typename F>
  void for_each_near(VertexId v, const F& f) const {
    if (v + 1 < first_.size()) {
      std::for_each(reds_.begin() + first_[v], reds_.begin() + first_[v + 1], f);
    }
    for (std::uint32_t at = v < last_.size() ? last_[v] : kNone; at != kNone; at = later_[at].before) {
      f(later_[at].red);
    }
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  struct Later {
    std::uint32_t red, before;
  };

  std::vector<std::uint32_t> first_;  // rows of reds_, one per vertex
  std::vector<std::uint32_t> reds_;
  std::vector<std::uint32_t> last_;  // of each vertex, into later_
  std::vector<Later> later_;
};

}  // namespace cbc3d
