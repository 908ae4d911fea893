// Vectors and matrices, of known values and by their identities.
#include <gtest/gtest.h>

#include <random>

#include "mesher/core/vec3.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

TEST(Vec3, KnownValues) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(x.cross(y), z);
  EXPECT_EQ(y.cross(x), -z);
  EXPECT_EQ((Vec3{1, 2, 3}.dot({4, -5, 6})), 12);
  EXPECT_EQ((Vec3{2, 3, 6}.norm()), 7);
  EXPECT_EQ((Vec3{0, 3, 4}.normalized()), (Vec3{0, 0.6, 0.8}));
  EXPECT_EQ(Vec3{}.normalized(), Vec3{});
  EXPECT_EQ((Vec3{3, -1, 2}.min_coeff()), -1);
  EXPECT_EQ((Vec3{3, -1, 2}.max_coeff()), 3);
  EXPECT_EQ((Vec3{2, 4, 6} / 2), (Vec3{1, 2, 3}));
  EXPECT_FALSE((Vec3{0, std::nan(""), 0}.all_finite()));
  Vec3 v{1, 2, 3};
  v[1] = 5;
  EXPECT_EQ(v[0] + v[1] + v[2], 9);
}

TEST(Vec3, ProductsOfMatricesAreProductsOfMaps) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const auto draw = [&] { return testing::draw_point(random, -2, 2); };
    const Mat3 a = Mat3::from_columns(draw(), draw(), draw());
    const Mat3 b{{draw(), draw(), draw()}};
    const Vec3 v = draw();
    EXPECT_LT(((a * b) * v - a * (b * v)).norm(), 1e-12);
    EXPECT_NEAR((a * b).determinant(), a.determinant() * b.determinant(), 1e-10);
    EXPECT_NEAR(a.transposed().determinant(), a.determinant(), 1e-12);
    EXPECT_EQ(a.transposed().transposed(), a);
    EXPECT_EQ(a.column(1), a * Vec3({0, 1, 0}));
    EXPECT_EQ(a(2, 1), a.column(1).z);
    EXPECT_EQ(Mat3::identity() * v, v);
    EXPECT_NEAR(draw().cross(v).dot(v), 0, 1e-12);
  }
}

}  // namespace
}  // namespace cbc3d
