// Four floats in a register do what single floats do.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "mesher/core/float4.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

/// Whole numbers, so that floats are exact.
Vec3 draw_whole(std::mt19937& random) {
  const Vec3 p = testing::draw_point(random, -100, 100);
  return {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
}

TEST(Float4, ArithmeticIsThatOfVectors) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = draw_whole(random);
    const Vec3 b = draw_whole(random);
    EXPECT_EQ((Float4(a) + Float4(b)).xyz(), a + b);
    EXPECT_EQ((Float4(a) - Float4(b)).xyz(), a - b);
    EXPECT_EQ((Float4(a) * Float4(b)).xyz(), (Vec3{a.x * b.x, a.y * b.y, a.z * b.z}));
    EXPECT_EQ((0.5F * Float4(a)).xyz(), 0.5 * a);
    const Float4 product = cross(Float4(a), Float4(b));
    EXPECT_EQ(product.xyz(), a.cross(b));
    EXPECT_EQ(product[3], 0);
    Float4 sum(a);
    sum += Float4(b);
    sum -= Float4(a);
    EXPECT_EQ(sum.xyz(), b);
  }
}

TEST(Float4, LanesAreSpreadReorderedAndTransposed) {
  const Float4 a(1, 2, 3, 4);
  for (int lane = 0; lane < 4; ++lane) {
    EXPECT_EQ(spread<2>(a)[lane], 3);
    EXPECT_EQ((reorder<3, 0, 2, 1>(a)[lane]),
              (std::array<float, 4>{4, 1, 3, 2}[static_cast<std::size_t>(lane)]));
  }
  const Float4 rows[3] = {{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}};
  Float4 columns[3];
  transpose(rows, columns);
  EXPECT_EQ(columns[0].xyz(), (Vec3{1, 4, 7}));
  EXPECT_EQ(columns[1].xyz(), (Vec3{2, 5, 8}));
  EXPECT_EQ(columns[2].xyz(), (Vec3{3, 6, 9}));
}

TEST(Float4, AnyLaneMayBeTheGreaterOne) {
  const Float4 zero(0.0F);
  EXPECT_FALSE(any_greater(zero, zero));
  EXPECT_FALSE(any_greater(Float4(-1, -2, -3, -4), zero));
  EXPECT_TRUE(any_greater(Float4(1, 0, 0, 0), zero));
  EXPECT_TRUE(any_greater(Float4(0, 1, 0, 0), zero));
  EXPECT_TRUE(any_greater(Float4(0, 0, 1, 0), zero));
  EXPECT_TRUE(any_greater(Float4(0, 0, 0, 1), zero));
}

TEST(Float4, StoringWritesThreeLanes) {
  std::array<float, 5> memory = {9, 9, 9, 9, 9};
  Float4(1, 2, 3, 4).store3(memory.data() + 1);
  EXPECT_EQ(memory, (std::array<float, 5>{9, 1, 2, 3, 9}));
  EXPECT_EQ(Float4::load(memory.data() + 1)[3], 9);
}

}  // namespace
}  // namespace cbc3d
