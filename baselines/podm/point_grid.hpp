// Points in the cells of a hashed grid, for the question which of them are near a place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesher/core/vec3.hpp"

namespace cbc3d::baselines::podm {

/// A set of points with a value each. Questions within a distance of half a cell look into eight cells.
template <typename Value>
class PointGrid {
 public:
  explicit PointGrid(double cell_mm) : cell_mm_(cell_mm) {}

  [[nodiscard]] std::size_t size() const { return size_; }

  void add(const Vec3& place, const Value& value) {
    std::uint32_t at = free_;
    if (at == kNone) {
      at = static_cast<std::uint32_t>(nodes_.size());
      nodes_.push_back({});
    } else {
      free_ = nodes_[at].next;
    }
    const auto head = heads_.try_emplace(key_of(cell_of(place)), kNone).first;
    nodes_[at] = {place, value, head->second};
    head->second = at;
    ++size_;
  }

  /// Removes a point that was added with this very place and value; false where there is none.
  bool remove(const Vec3& place, const Value& value) {
    const auto head = heads_.find(key_of(cell_of(place)));
    if (head == heads_.end()) return false;
    for (std::uint32_t* link = &head->second; *link != kNone; link = &nodes_[*link].next) {
      Node& node = nodes_[*link];
      if (!(node.place == place) || !(node.value == value)) continue;
      const std::uint32_t at = *link;
      *link = node.next;
      node.next = free_;
      free_ = at;
      --size_;
      return true;
    }
    return false;
  }

  /// Calls visit(place, value) for every point nearer than `reach_mm`, until it returns true; true if it did.
  template <typename Visit>
  bool any_within(const Vec3& place, double reach_mm, Visit visit) const {
    const Vec3 reach{reach_mm, reach_mm, reach_mm};
    const Cell low = cell_of(place - reach), high = cell_of(place + reach);
    for (std::int64_t k = low[2]; k <= high[2]; ++k) {
      for (std::int64_t j = low[1]; j <= high[1]; ++j) {
        for (std::int64_t i = low[0]; i <= high[0]; ++i) {
          if (any_in_cell({i, j, k}, place, reach_mm, visit)) return true;
        }
      }
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  using Cell = std::array<std::int64_t, 3>;
  struct Node {
    Vec3 place;
    Value value{};
    std::uint32_t next = kNone;
  };
  struct Mixed {
    std::size_t operator()(std::uint64_t key) const {
      key *= 0x9E3779B97F4A7C15ULL;
      return static_cast<std::size_t>(key ^ (key >> 32));
    }
  };

  [[nodiscard]] Cell cell_of(const Vec3& p) const {
    Cell cell{};
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor(p[static_cast<int>(a)] / cell_mm_));
    return cell;
  }
  // Twenty-one bits for each axis; what lies that far apart is told apart by its distance.
  static std::uint64_t key_of(const Cell& cell) {
    constexpr std::uint64_t kMask = (1ULL << 21) - 1;
    return (static_cast<std::uint64_t>(cell[0]) & kMask) |
           ((static_cast<std::uint64_t>(cell[1]) & kMask) << 21) |
           ((static_cast<std::uint64_t>(cell[2]) & kMask) << 42);
  }
  template <typename Visit>
  bool any_in_cell(const Cell& cell, const Vec3& place, double reach_mm, Visit& visit) const {
    const auto head = heads_.find(key_of(cell));
    if (head == heads_.end()) return false;
    for (std::uint32_t at = head->second; at != kNone; at = nodes_[at].next) {
      const Node& node = nodes_[at];
      if ((node.place - place).squared_norm() < reach_mm * reach_mm && visit(node.place, node.value))
        return true;
    }
    return false;
  }

  double cell_mm_;
  std::unordered_map<std::uint64_t, std::uint32_t, Mixed> heads_;
  std::vector<Node> nodes_;
  std::uint32_t free_ = kNone;
  std::size_t size_ = 0;
};

}  // namespace cbc3d::baselines::podm
