// A flag for every voxel, one bit each.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cbc3d {

/// Bits numbered by voxel offset. All are clear at first.
class VoxelBits {
 public:
  explicit VoxelBits(std::size_t voxels) : words_((voxels + kWordBits - 1) / kWordBits, 0) {}

  [[nodiscard]] bool test(std::size_t v) const { return (words_[v / kWordBits] >> v % kWordBits & 1U) != 0; }
  void set(std::size_t v) { words_[v / kWordBits] |= std::uint64_t{1} << v % kWordBits; }
  void clear() { std::fill(words_.begin(), words_.end(), 0); }

  /// True when one of the bits [begin, end) is set.
  [[nodiscard]] bool any(std::size_t begin, std::size_t end) const {
    bool found = false;
    for (std::size_t at = begin; at < end && !found; at = next_word(at)) {
      found = (words_[at / kWordBits] & mask(at, end)) != 0;
    }
    return found;
  }

  /// Calls visit(v) for the set bits of [begin, end), ascending.
  template <typename Visit>
  void for_each(std::size_t begin, std::size_t end, const Visit& visit) const {
    for (std::size_t at = begin; at < end; at = next_word(at)) {
      std::uint64_t left = words_[at / kWordBits] & mask(at, end);
      for (; left != 0; left &= left - 1) {
        visit(at / kWordBits * kWordBits + static_cast<std::size_t>(std::countr_zero(left)));
      }
    }
  }

 private:
  static constexpr std::size_t kWordBits = 64;

  static std::size_t next_word(std::size_t at) { return (at / kWordBits + 1) * kWordBits; }
  /// The bits from `at` to `end` in the word of `at`.
  static std::uint64_t mask(std::size_t at, std::size_t end) {
    const std::uint64_t from = ~std::uint64_t{0} << at % kWordBits;
    return end < next_word(at) ? from & ~(~std::uint64_t{0} << end % kWordBits) : from;
  }

  std::vector<std::uint64_t> words_;
};

}  // namespace cbc3d
