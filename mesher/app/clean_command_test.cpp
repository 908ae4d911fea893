// `cbc3d clean` as its users meet it.
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using CleanCommand = testing::CommandTest;

TEST_F(CleanCommand, CleansAnImageAndReportsTheChanges) {
  LabelImage image = testing::ball_image(24, 1, 8);
  image.voxels[image.frame.offset(1, 1, 1)] = image.voxels[image.frame.offset(2, 2, 1)] =
      1;  // an edge contact
  write_label_image(image, at("edge.nii.gz"));
  const testing::Outcome outcome =
      testing::run_command("clean " + at("edge.nii.gz") + " --region-tolerance 0 --out " +
                           at("clean.nii.gz") + " --report " + at("c.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1 edge contacts removed"), std::string::npos) << outcome.text;
  const LabelImage clean = read_label_image(at("clean.nii.gz"));
  EXPECT_EQ(clean.voxels_per_material()[1], image.voxels_per_material()[1] + 1);
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(testing::bytes_of(at("c.json")))["labels"][0]["volume_change_mm3"],
                   1);
}

TEST_F(CleanCommand, FillsHolesWhenAsked) {
  LabelImage image = testing::ball_image(16, 1, 6);
  const std::size_t voxels = image.voxels_per_material()[1];
  image.voxels[image.frame.offset(8, 8, 8)] = kBackground;
  write_label_image(image, at("hole.nii.gz"));
  const testing::Outcome outcome = testing::run_command("clean " + at("hole.nii.gz") +
                                                        " --relabel-noise holes --out " + at("full.nii.gz"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(read_label_image(at("full.nii.gz")).voxels_per_material()[1], voxels);
}

TEST_F(CleanCommand, RefusesBadInputInOneLine) {
  write_label_image(testing::ball_image(8, 1, 3), at("ball.nii.gz"));
  const std::string files = "clean " + at("ball.nii.gz") + " --out " + at("c.nii.gz");
  expect_refusal(files + " --region-tolerance 2", "--region-tolerance 2: give a number in [0, 1]",
                 "c.nii.gz");
  expect_refusal(files + " --fidelity 0.5", "--fidelity", "c.nii.gz");
  expect_refusal("clean " + at("absent.nii") + " --out " + at("c.nii.gz"), "does not exist", "c.nii.gz");
}

}  // namespace
}  // namespace cbc3d
