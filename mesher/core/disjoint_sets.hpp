// Disjoint sets of numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cbc3d {

/// The lowest number of a set is its root.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

  std::uint32_t root(std::uint32_t n) {
    while (parent_[n] != n) {
      parent_[n] = parent_[parent_[n]];
      n = parent_[n];
    }
    return n;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  /// The numbers of each set, ascending; the sets by their roots.
  std::vector<std::vector<std::uint32_t>> members() {
    std::vector<std::vector<std::uint32_t>> sets;
    std::vector<std::size_t> set_of(size());
    for (std::uint32_t n = 0; n < size(); ++n) {
      const std::uint32_t first = root(n);
      if (first == n) {
        set_of[n] = sets.size();
        sets.emplace_back();
      }
      sets[set_of[first]].push_back(n);
    }
    return sets;
  }
  [[nodiscard]] std::size_t size() const { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace cbc3d
