// Memory of images in large pages, where the system has them: one page fault in place of 512, and fewer
// misses of the page table where reads are scattered.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "mesher/core/uninitialized_vector.hpp"

namespace cbc3d {

/// An allocator for std::vector; a block smaller than a few pages is allocated as usual. A vector that is
/// filled in parallel has its pages first touched in parallel.
template <typename T>
struct LargePages : LeavesUninitialized {
  using value_type = T;
  LargePages() = default;
  template <typename U>
  LargePages(const LargePages<U>& /*other*/) {}  // NOLINT: allocators convert

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* const memory =
        bytes < kLeast ? std::malloc(std::max<std::size_t>(bytes, 1)) : allocate_large(bytes);
    if (memory == nullptr) {
      throw std::bad_alloc();
    }
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*count*/) { std::free(memory); }
  bool operator==(const LargePages& /*other*/) const { return true; }

 private:
  static constexpr std::size_t kPage = std::size_t{2} << 20U, kLeast = 2 * kPage;

  static void* allocate_large(std::size_t bytes) {
    const std::size_t whole = (bytes + kPage - 1) / kPage * kPage;
    void* const memory = whole < bytes ? nullptr : std::aligned_alloc(kPage, whole);
#ifdef MADV_HUGEPAGE
    if (memory != nullptr) {
      static_cast<void>(::madvise(memory, whole, MADV_HUGEPAGE));  // the system may ignore this advice
    }
#endif
    return memory;
  }
};

}  // namespace cbc3d
