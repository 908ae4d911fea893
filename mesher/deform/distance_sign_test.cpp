// The refinement criterion reads signs of distance maps off the image. ITK's signed Maurer map is the
// reference.
#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

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

TEST(DistanceSign, IsWhatTheImageSays) {
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

}  // namespace
}  // namespace cbc3d
