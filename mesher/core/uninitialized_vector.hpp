// Vectors whose elements have no value until one is written.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace cbc3d {

/// Makes an allocator leave elements unset that are given no value. Zeroing a million elements that are
/// written a moment later costs serial time, and it places their pages near the thread that zeroes them,
/// not near those that use them.
struct LeavesUninitialized {
  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};

template <typename T>
struct UninitializedAllocator : std::allocator<T>, LeavesUninitialized {
  UninitializedAllocator() = default;
  template <typename U>
  UninitializedAllocator(const UninitializedAllocator<U>& /*other*/) {}  // NOLINT: allocators convert
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
};

/// After UninitializedVector(n) or resize(n) every new element is to be written before it is read.
template <typename T>
using UninitializedVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace cbc3d
