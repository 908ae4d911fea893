// Segmentation of grey images whose truth is known: a winding vessel under noise.
#include "mesher/segment/segment_image.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

// A vessel that winds upwards through an image 44 x 44 x 60 mm.
struct Vessel {
  double x, y, radius;

  [[nodiscard]] Vec3 middle(double z) const {
    return {x + 5 * std::sin(z / 11), y + 4 * std::cos(z / 14), z};
  }
  [[nodiscard]] double distance(const Vec3& p) const {
    double least = 1e9;
    for (double z = 6; z <= 54; z += 0.25) {
      least = std::min(least, (p - middle(z)).norm());
    }
    return least - radius;
  }
};

ImageFrame frame_of_44x44x60_mm(const Vec3& spacing_mm) {
  ImageFrame frame;
  frame.spacing_mm = spacing_mm;
  frame.size = {static_cast<int>(44 / spacing_mm.x), static_cast<int>(44 / spacing_mm.y),
                static_cast<int>(60 / spacing_mm.z)};
  return frame;
}

/// Grey values (100 around, 100 + contrast within, blurred over a voxel, normal noise) written as an image,
/// and the truth.
LabelImage write_grey(const fs::path& path, const ImageFrame& frame,
                      const std::function<double(const Vec3&)>& distance_at, double contrast, double noise) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, noise);
  LabelImage grey, truth;
  grey.frame = truth.frame = frame;
  truth.labels = {0, 1};
  for (Label value = 1; value < 1000; ++value) {
    grey.labels.push_back(value);
  }
  const double blur = 0.4 * frame.spacing_mm.max_coeff();
  for (std::size_t v = 0; v < frame.voxel_count(); ++v) {
    const Index3 at = frame.index_of(v);
    const double distance = distance_at(frame.local_centre(at[0], at[1], at[2]));
    const double within = 1 / (1 + std::exp(distance / blur));
    const double value = 300 + contrast * within + normal(random);
    grey.voxels.push_back(static_cast<MaterialId>(std::clamp(value, 1.0, 999.0)));
    truth.voxels.push_back(distance <= 0 ? 1 : 0);
  }
  write_label_image(grey, path);
  return truth;
}

double dice(const LabelImage& a, const LabelImage& b) {
  std::size_t both = 0, sum = 0;
  for (std::size_t v = 0; v < a.voxels.size(); ++v) {
    both += a.voxels[v] == 1 && b.voxels[v] == 1 ? 1 : 0;
    sum += (a.voxels[v] == 1 ? 1 : 0) + (b.voxels[v] == 1 ? 1 : 0);
  }
  return 2 * static_cast<double>(both) / static_cast<double>(sum);
}

class Segment : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cbc3d-segment-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  double dice_of(const ImageFrame& frame, double contrast, double noise, double radius) {
    const Vessel vessel{22, 22, radius};
    const LabelImage truth = write_grey(
        folder_ / "grey.nrrd", frame, [&](const Vec3& p) { return vessel.distance(p); }, contrast, noise);
    SegmentOptions options;
    options.seeds_mm = {frame.to_physical(vessel.middle(8))};
    options.targets_mm = {frame.to_physical(vessel.middle(52))};
    Progress quiet;
    const LabelImage found = segment_image(folder_ / "grey.nrrd", options, quiet, report_);
    EXPECT_EQ(found.frame.size, frame.size);
    EXPECT_LT((found.frame.origin_mm - frame.origin_mm).norm(), 1e-6);
    return dice(found, truth);
  }
  fs::path folder_;
  SegmentReport report_;
};

TEST_F(Segment, NoisyVesselFromTwoClicks) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), 200, 30, 5), .95);
  EXPECT_NEAR(report_.inside_level, 500, 20);
  EXPECT_NEAR(report_.outside_level, 300, 20);
  EXPECT_GT(report_.iterations, 0);
}

TEST_F(Segment, DarkVesselIsAsGood) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), -200, 30, 5), .95);
}

TEST_F(Segment, ObliqueAnisotropicImage) {
  EXPECT_GE(dice_of(testing::oblique(frame_of_44x44x60_mm({.8, .8, 1.2}), true), 200, 30, 5), .95);
}

TEST_F(Segment, WeakNoiseThinVessel) {
  EXPECT_GE(dice_of(frame_of_44x44x60_mm({1, 1, 1}), 200, 10, 3.5), .93);
}

// The paper's way with an aneurysm: one seed in its middle, one target on its wall.
TEST_F(Segment, RoundSacFromItsMiddleAndItsWall) {
  const Vec3 middle{22, 23, 30};
  const LabelImage truth = write_grey(
      folder_ / "sac.nrrd", frame_of_44x44x60_mm({1, 1, 1}),
      [&](const Vec3& p) { return (p - middle).norm() - 13; }, 200, 30);
  SegmentOptions options;
  options.seeds_mm = {middle};
  options.targets_mm = {middle + Vec3{0, 13, 0}};
  Progress quiet;
  EXPECT_GE(dice(segment_image(folder_ / "sac.nrrd", options, quiet, report_), truth), .95);
}

TEST_F(Segment, RefusesWhatCannotWork) {
  const ImageFrame frame = frame_of_44x44x60_mm({2, 2, 2});
  write_grey(
      folder_ / "grey.nrrd", frame,
      [](const Vec3& p) {
        return Vessel{22, 22, 5}.distance(p);
      },
      200, 10);
  Progress quiet;
  SegmentOptions options;
  options.targets_mm = {{22, 22, 30}};
  EXPECT_THROW(segment_image(folder_ / "grey.nrrd", options, quiet, report_), InputError);
  options.seeds_mm = {{22, 22, 300}};
  EXPECT_THROW(segment_image(folder_ / "grey.nrrd", options, quiet, report_), InputError);
  options.seeds_mm = {{22, 22, 20}};
  EXPECT_THROW(segment_image(folder_ / "absent.nrrd", options, quiet, report_), InputError);
  write_grey(
      folder_ / "flat.nrrd", frame, [](const Vec3&) { return 1e9; }, 0, 0);
  EXPECT_THROW(segment_image(folder_ / "flat.nrrd", options, quiet, report_), InputError);
}

TEST_F(Segment, CommandMergesStructures) {
  const ImageFrame frame = frame_of_44x44x60_mm({1, 1, 1});
  const Vessel left{12, 22, 4}, right{32, 22, 4};
  write_grey(
      folder_ / "grey.nii.gz", frame,
      [&](const Vec3& p) { return std::min(left.distance(p), right.distance(p)); }, 200, 20);
  const auto text = [](const Vec3& p) {
    return " " + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
  };
  const auto command = [&](const Vessel& vessel, const std::string& rest) {
    const std::string line = std::string(CBC3D_COMMAND) + " segment " + (folder_ / "grey.nii.gz").string() +
                             " --seeds" + text(vessel.middle(8)) + " --targets" + text(vessel.middle(52)) +
                             " --out " + (folder_ / "labels.nii.gz").string() + " --quiet " + rest;
    return WEXITSTATUS(std::system(line.c_str()));
  };
  ASSERT_EQ(command(left, "--label 7"), 0);
  ASSERT_EQ(command(right, "--label -3 --merge " + (folder_ / "labels.nii.gz").string()), 0);
  const LabelImage both = read_label_image(folder_ / "labels.nii.gz");
  EXPECT_EQ(both.labels, (std::vector<Label>{0, -3, 7}));
  EXPECT_EQ(both.labels[both.at_local(left.middle(30))], 7);
  EXPECT_EQ(both.labels[both.at_local(right.middle(30))], -3);
  EXPECT_EQ(command(right, "--label 0 2>/dev/null"), 2);
}

}  // namespace
}  // namespace cbc3d
