// Serial passes of the standard library's kind over several threads, with results that do not depend on how
// many there are.
#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cbc3d {

/// Sets a mark to another value; returns true in the one thread that does so first.
inline bool is_first(std::uint32_t& mark, std::uint32_t to) {
  const std::atomic_ref<std::uint32_t> shared(mark);
  return shared.load(std::memory_order_relaxed) != to && shared.exchange(to, std::memory_order_relaxed) != to;
}

/// Collects the values that f(index, add) adds by calls of add(value), at most `most` for each index below
/// `count`, in the order of the indices.
template <typename T, typename F>
std::vector<T> collect(std::size_t count, std::size_t most, const F& f) {
  constexpr std::size_t kLeastPiece = 1024;
  const std::size_t pieces = std::clamp<std::size_t>(count / kLeastPiece, 1, 64);
  const auto found = std::make_unique_for_overwrite<T[]>(most * count);
  std::vector<std::size_t> ends(pieces);
#pragma omp parallel for schedule(dynamic) if (pieces > 1)
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    const std::size_t begin = piece * count / pieces, end = (piece + 1) * count / pieces;
    T* next = found.get() + most * begin;
    for (std::size_t i = begin; i < end; ++i) {
      f(i, [&next](const T& value) { *next++ = value; });
    }
    ends[piece] = static_cast<std::size_t>(next - found.get());
  }
  std::vector<T> all;
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    all.insert(all.end(), found.get() + most * (piece * count / pieces), found.get() + ends[piece]);
  }
  return all;
}

/// The indices below `count` for which is(index), ascending.
template <typename Is>
std::vector<std::uint32_t> indices_where(std::size_t count, const Is& is) {
  return collect<std::uint32_t>(count, 1, [&](std::size_t i, const auto& add) {
    if (is(i)) {
      add(static_cast<std::uint32_t>(i));
    }
  });
}

/// Cuts `count` rows into one range for each thread and runs f(begin, end) on each. To fill rows, each thread
/// reads the whole input and takes what belongs to its rows: repeated reading costs less than scattered
/// writes, which are thereby shared among the threads.
template <typename F>
void for_ranges(std::size_t count, const F& f) {
  const auto parts = static_cast<std::size_t>(std::min(8, omp_get_max_threads()));
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    f(part * count / parts, (part + 1) * count / parts);
  }
}

/// Sorts values of which no two are equal, so that there is only one order.
template <typename T>
void sort_distinct(std::vector<T>& values) {
  constexpr std::size_t kLeastPiece = 4096;
  const auto at = [&](std::size_t piece, std::size_t pieces) {
    return values.begin() + static_cast<std::ptrdiff_t>(piece * values.size() / pieces);
  };
  std::size_t pieces = 1;
  while (pieces < static_cast<std::size_t>(omp_get_max_threads()) &&
         values.size() / pieces > 2 * kLeastPiece) {
    pieces *= 2;
  }
#pragma omp parallel for schedule(static, 1) if (pieces > 1)
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    std::sort(at(piece, pieces), at(piece + 1, pieces));
  }
  for (std::size_t pairs = pieces / 2; pairs > 0; pairs /= 2) {
#pragma omp parallel for schedule(static, 1) if (pairs > 1)
    for (std::size_t pair = 0; pair < pairs; ++pair) {
      std::inplace_merge(at(2 * pair, 2 * pairs), at(2 * pair + 1, 2 * pairs), at(2 * pair + 2, 2 * pairs));
    }
  }
}

}  // namespace cbc3d
