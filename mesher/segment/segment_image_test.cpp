// Segmentation of grey images whose truth is known: a winding vessel under noise.
#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/segment/segment_image.hpp"
#include "mesher/segment/testing_vessel.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::frame_of_44x44x60_mm;
using testing::Vessel;
using testing::write_grey;

double dice(const LabelImage& a, const LabelImage& b) {
  std::size_t both = 0, sum = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    both += a.voxels[v] == 1 && b.voxels[v] == 1 ? 1 : 0;
    sum += (a.voxels[v] == 1 ? 1 : 0) + (b.voxels[v] == 1 ? 1 : 0);
  }
  return 2 * static_cast<double>(both) / static_cast<double>(sum);
}

class SegmentImage : public ::testing::Test {
 protected:
  double dice_of(const ImageFrame& frame, double contrast, double noise, double radius) {
    const Vessel vessel{22, 22, radius};
    const LabelImage truth = write_grey(
        folder_.file("grey.nrrd"), frame, [&](const Vec3& p) { return vessel.distance(p); }, contrast, noise);
    SegmentOptions options;
    options.seeds_mm = {frame.to_physical(vessel.middle(8))};
    options.targets_mm = {frame.to_physical(vessel.middle(52))};
    Progress quiet;
    const LabelImage found = segment_image(folder_.file("grey.nrrd"), options, quiet, report_);
    EXPECT_EQ(found.frame.size, frame.size);
    EXPECT_LT((found.frame.origin_mm - frame.origin_mm).norm(), 1e-6);
    return dice(found, truth);
  }
  testing::TemporaryFolder folder_{"segment"};
  SegmentReport report_;
};

TEST_F(SegmentImage, NoisyVesselFromTwoClicks) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), 200, 30, 5), .95);
  EXPECT_NEAR(report_.inside_level, 500, 20);
  EXPECT_NEAR(report_.outside_level, 300, 20);
  EXPECT_GT(report_.iterations, 0);
}

TEST_F(SegmentImage, DarkVesselIsAsGood) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), -200, 30, 5), .95);
}

TEST_F(SegmentImage, ObliqueAnisotropicImage) {
  EXPECT_GE(dice_of(testing::oblique(frame_of_44x44x60_mm({.8, .8, 1.2}), true), 200, 30, 5), .95);
}

TEST_F(SegmentImage, WeakNoiseThinVessel) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), 200, 10, 3.5), .93);
}

// The paper's way with an aneurysm: one seed in its middle, one target on its wall.
TEST_F(SegmentImage, RoundSacFromItsMiddleAndItsWall) {
  const Vec3 middle{22, 23, 30};
  const LabelImage truth = write_grey(
      folder_.file("sac.nrrd"), frame_of_44x44x60_mm({1, 1, 1}),
      [&](const Vec3& p) { return (p - middle).norm() - 13; }, 200, 30);
  SegmentOptions options;
  options.seeds_mm = {middle};
  options.targets_mm = {middle + Vec3{0, 13, 0}};
  Progress quiet;
  EXPECT_GE(dice(segment_image(folder_.file("sac.nrrd"), options, quiet, report_), truth), .95);
}

TEST_F(SegmentImage, RefusesWhatCannotWork) {
  const ImageFrame frame = frame_of_44x44x60_mm({2, 2, 2});
  write_grey(
      folder_.file("grey.nrrd"), frame,
      [](const Vec3& p) {
        return Vessel{22, 22, 5}.distance(p);
      },
      200, 10);
  Progress quiet;
  SegmentOptions options;
  options.targets_mm = {{22, 22, 30}};
  EXPECT_THROW(segment_image(folder_.file("grey.nrrd"), options, quiet, report_), InputError);
  options.seeds_mm = {{22, 22, 300}};
  EXPECT_THROW(segment_image(folder_.file("grey.nrrd"), options, quiet, report_), InputError);
  options.seeds_mm = {{22, 22, 20}};
  EXPECT_THROW(segment_image(folder_.file("absent.nrrd"), options, quiet, report_), InputError);
  write_grey(
      folder_.file("flat.nrrd"), frame, [](const Vec3&) { return 1e9; }, 0, 0);
  EXPECT_THROW(segment_image(folder_.file("flat.nrrd"), options, quiet, report_), InputError);
}

}  // namespace
}  // namespace cbc3d
