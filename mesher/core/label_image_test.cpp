// What an image says of places, against searches through all its voxels.
#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <array>
#include <random>

#include "mesher/core/label_image.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using Mask = itk::Image<unsigned char, 3>;
using Distance = itk::Image<float, 3>;

Distance::Pointer signed_maurer(const LabelImage& image, MaterialId material) {
  auto mask = Mask::New();
  Mask::RegionType region;
  for (unsigned d = 0; d < 3; ++d) {
    region.SetSize(d, static_cast<itk::SizeValueType>(image.frame.size[d]));
  }
  mask->SetRegions(region);
  mask->Allocate();
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    mask->GetBufferPointer()[v] = image.voxels[v] == material ? 1 : 0;
  }
  auto filter = itk::SignedMaurerDistanceMapImageFilter<Mask, Distance>::New();
  filter->SetInput(mask);
  filter->SetInsideIsPositive(true);
  filter->SetUseImageSpacing(true);
  filter->SetSquaredDistance(false);
  filter->Update();
  return filter->GetOutput();
}

/// ITK's zero level: inside voxels with one of the 26 neighbours outside (the boundary voxels of the paper's
/// target points are fewer: those with a face neighbour outside).
bool touches_another(const LabelImage& image, const Index3& at) {
  for (int n = 0; n < 27; ++n) {
    if (image.at_or_background(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1) !=
        image.at(at[0], at[1], at[2])) {
      return true;
    }
  }
  return false;
}

/// The refinement criterion reads signs of distance maps off the image; ITK's signed Maurer map is the
/// reference.
TEST(LabelImage, SaysTheSignOfItsDistanceMaps) {
  const LabelImage image = testing::noise_image(18, 0.6, 21);  // its rim is background
  for (const MaterialId material : {MaterialId{1}, MaterialId{2}}) {
    const auto distance = signed_maurer(image, material);
    std::size_t zeros = 0;
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const float d = distance->GetBufferPointer()[v];
      const Index3 at = image.frame.index_of(v);
      EXPECT_EQ(image.voxels[v] == material, d >= 0) << v;  // negative: outside
      const bool boundary = image.voxels[v] == material && touches_another(image, at);
      EXPECT_EQ(boundary, d == 0) << v;
      zeros += boundary ? 1 : 0;
    }
    EXPECT_GT(zeros, 100U);
  }
}

TEST(LabelImage, NearestBoundaryVoxelIsThatOfAFullSearch) {
  std::mt19937 random(3);
  const LabelImage image = testing::make_image({9, 8, 7}, {1, 0.7, 1.6}, 4, [&](const Vec3&) {
    return random() % 3 == 0 ? static_cast<int>(random() % 4) : 1;
  });
  int found = 0;
  for (int n = 0; n < 400; ++n) {
    const auto draw = [&](double size) { return size * 1.2 * (random() / 4294967296.0) - 1; };
    const Vec3 at = {draw(9 * image.frame.spacing_mm.x), draw(8 * image.frame.spacing_mm.y),
                     draw(7 * image.frame.spacing_mm.z)};
    const auto m = static_cast<MaterialId>(n % 4);
    const double reach = 0.3 + 0.01 * n;
    double least = reach * reach;
    bool any = false;
    for (int k = 0; k < 7; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 9; ++i) {
          const auto beside = [&](int di, int dj, int dk) {
            return image.at_or_background(i + di, j + dj, k + dk);
          };
          const std::array<MaterialId, 6> around = {beside(1, 0, 0),  beside(-1, 0, 0), beside(0, 1, 0),
                                                    beside(0, -1, 0), beside(0, 0, 1),  beside(0, 0, -1)};
          const MaterialId own = image.at(i, j, k);
          const bool counts = m == kBackground ? own != kBackground &&
                                                     std::count(around.begin(), around.end(), kBackground) > 0
                                               : own == m && std::count(around.begin(), around.end(), m) < 6;
          const double d = (image.frame.local_centre(i, j, k) - at).squared_norm();
          if (counts && d <= least) {
            least = d;
            any = true;
          }
        }
      }
    }
    const auto got = nearest_boundary_voxel(image, at, m, reach);
    ASSERT_EQ(got.has_value(), any);
    EXPECT_EQ(has_boundary_voxel_near(image, at, m, reach), any);
    if (got) {
      EXPECT_NEAR((*got - at).squared_norm(), least, 1e-12);
    }
    found += any ? 1 : 0;
  }
  EXPECT_GT(found, 50);
  EXPECT_LT(found, 390);
}

}  // namespace
}  // namespace cbc3d
