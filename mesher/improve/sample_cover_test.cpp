// Which vertices of a mesh of two layers cover the samples on the plane between them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/improve/sample_cover.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"

namespace cbc3d {
namespace {

using testing::kPlane;
using testing::kSize;
using testing::layers;
using testing::samples_on_plane;
using testing::two_layers;

/// From the middle of a square to its corners.
const double kHalfDiagonal = std::sqrt(0.5);

std::vector<BoundarySample> with_one_above() {
  std::vector<BoundarySample> samples = samples_on_plane();
  samples.push_back({{3, 3, 4.5F}, 1, 2});
  return samples;
}

TEST(SampleCover, SamplesWithinTheReachAreCoveredByCornersOfTheirSquares) {
  const MaterialMesh mesh = two_layers(kSize, kPlane);
  const SampleCover cover = cover_samples(mesh, layers(with_one_above()), 0.8, false);
  ASSERT_EQ(cover.covering.size(), cover.samples.size());
  for (std::size_t s = 0; s + 1 < cover.samples.size(); ++s) {
    ASSERT_NE(cover.covering[s], kNoVertex);
    EXPECT_NEAR((mesh.points[cover.covering[s]] - cover.samples[s].centre()).norm(), kHalfDiagonal, 1e-6);
  }
  EXPECT_EQ(cover.covering.back(), kNoVertex);
  EXPECT_TRUE(has_far_samples(mesh, cover, 0.8));
}

TEST(SampleCover, KeptDistancesCoverWhatIsBeyondTheReachToo) {
  const MaterialMesh mesh = two_layers(kSize, kPlane);
  const SampleCover cover = cover_samples(mesh, layers(with_one_above()), 1.2, true);
  EXPECT_NEAR(cover.reach_mm, kHalfDiagonal + 0.05, 1e-6);  // no larger than what is covered needs
  ASSERT_NE(cover.covering.back(), kNoVertex);
  EXPECT_NEAR(cover.own_reach_mm.back(), 1.5 + 0.05, 1e-6);
  EXPECT_EQ(cover.own_reach_mm.front(), 0);
  EXPECT_FALSE(has_far_samples(mesh, cover, 1.6));
}

TEST(SampleCover, UncoveredSamplesAreCoveredOnceAVertexComesNear) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const auto domain = layers(with_one_above());
  SampleCover cover = cover_samples(mesh, domain, 0.8, false);
  *std::find(mesh.points.begin(), mesh.points.end(), Vec3{3, 3, kPlane}) = {3, 3, 3.9};
  cover_uncovered_samples(mesh, cover);
  ASSERT_NE(cover.covering.back(), kNoVertex);
  EXPECT_EQ(mesh.points[cover.covering.back()], (Vec3{3, 3, 3.9}));
  cover_thin_samples(mesh, domain, 0.8, cover);
  EXPECT_EQ(cover.own_reach_mm, std::vector<float>(cover.samples.size(), 0));  // the plane has no thin part
}

}  // namespace
}  // namespace cbc3d
