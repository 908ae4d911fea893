// Passes over several threads: the same as one thread's.
#include "mesher/core/parallel.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

using testing::at_thread_counts;

TEST(Parallel, IndicesAreAscendingAndComplete) {
  for (const std::size_t count : {0, 1, 4095, 8192, 100001}) {
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (i % 7 == 3 || i + 1 == count) {
        wanted.push_back(i);
      }
    }
    at_thread_counts([&] {
      EXPECT_EQ(indices_where(count, [&](std::size_t i) { return i % 7 == 3 || i + 1 == count; }), wanted);
    });
  }
}

TEST(Parallel, CollectsInOrder) {
  for (const std::size_t count : {0, 1, 2047, 2048, 100001}) {
    std::vector<std::uint64_t> wanted;
    for (std::size_t i = 0; i < count; ++i) {
      wanted.insert(wanted.end(), i % 4, i);
    }
    at_thread_counts([&] {
      EXPECT_EQ(collect<std::uint64_t>(count, 3,
                                       [](std::size_t i, const auto& add) {
                                         for (std::size_t n = 0; n < i % 4; ++n) {
                                           add(i);
                                         }
                                       }),
                wanted);
    });
  }
}

TEST(Parallel, OneThreadIsFirst) {
  at_thread_counts([] {
    std::vector<std::uint32_t> marks(10000, 4);
    for (const std::uint32_t to : {5U, 6U}) {
      const auto first = collect<std::size_t>(10 * marks.size(), 1, [&](std::size_t i, const auto& add) {
        if (is_first(marks[i % marks.size()], to)) {
          add(i);
        }
      });
      EXPECT_EQ(first.size(), marks.size());
      EXPECT_EQ(marks, std::vector<std::uint32_t>(marks.size(), to));
    }
  });
}

TEST(Parallel, SortsLikeOneThread) {
  for (const std::size_t count : {0, 1, 5000, 20000, 100001}) {
    std::vector<std::uint32_t> shuffled(count);
    std::iota(shuffled.begin(), shuffled.end(), 17U);
    const std::vector<std::uint32_t> wanted = shuffled;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(3));
    at_thread_counts([&] {
      std::vector<std::uint32_t> values = shuffled;
      sort_distinct(values);
      EXPECT_EQ(values, wanted) << count << " values, " << omp_get_max_threads() << " threads";
    });
  }
}

}  // namespace
}  // namespace cbc3d
