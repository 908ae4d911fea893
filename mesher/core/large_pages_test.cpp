// Memory in large pages is memory like any other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "mesher/core/large_pages.hpp"

namespace cbc3d {
namespace {

TEST(LargePages, VectorsOfAnySizeKeepTheirValues) {
  for (const std::size_t count : {std::size_t{1}, std::size_t{5000}, std::size_t{5} << 20U}) {
    std::vector<std::uint8_t, LargePages<std::uint8_t>> values(count, 7);
    values.back() = 9;
    values.push_back(11);
    EXPECT_EQ(values[count - 1], 9);
    EXPECT_EQ(values[count], 11);
    EXPECT_EQ(std::count(values.begin(), values.end(), 7), static_cast<std::ptrdiff_t>(count) - 1);
    EXPECT_EQ((std::vector<std::uint8_t, LargePages<std::uint8_t>>(values)), values);
  }
}

TEST(LargePages, LargeBlocksBeginAtALargePage) {
  constexpr std::size_t kPage = std::size_t{2} << 20U;
  LargePages<double> pages;
  double* const block = pages.allocate(kPage);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % kPage, 0U);
  pages.deallocate(block, kPage);
  EXPECT_TRUE(pages == LargePages<double>());
}

TEST(LargePages, WhatCannotBeHadIsSaid) {
  volatile std::size_t count = ~std::size_t{0} - 5;
  EXPECT_THROW(static_cast<void>(LargePages<std::uint8_t>().allocate(count)), std::bad_alloc);
}

}  // namespace
}  // namespace cbc3d
