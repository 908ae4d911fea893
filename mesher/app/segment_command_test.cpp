// The command `cbc3d segment`.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/segment/testing_vessel.hpp"
#include "mesher/testing/run_command.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

using testing::frame_of_44x44x60_mm;
using testing::Vessel;
using testing::write_grey;

TEST(SegmentCommand, MergesStructures) {
  const testing::TemporaryFolder folder("segment-command");
  const ImageFrame frame = frame_of_44x44x60_mm({1, 1, 1});
  const Vessel left{12, 22, 4}, right{32, 22, 4};
  write_grey(
      folder.file("grey.nii.gz"), frame,
      [&](const Vec3& p) { return std::min(left.distance(p), right.distance(p)); }, 200, 20);
  const auto text = [](const Vec3& p) {
    return " " + std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
  };
  const auto command = [&](const Vessel& vessel, const std::string& rest) {
    const std::string line = "segment " + folder.file("grey.nii.gz").string() + " --seeds" +
                             text(vessel.middle(8)) + " --targets" + text(vessel.middle(52)) + " --out " +
                             folder.file("labels.nii.gz").string() + " --quiet " + rest;
    return testing::run_command(line).exit_code;
  };
  ASSERT_EQ(command(left, "--label 7"), 0);
  ASSERT_EQ(command(right, "--label -3 --merge " + folder.file("labels.nii.gz").string()), 0);
  const LabelImage both = read_label_image(folder.file("labels.nii.gz"));
  EXPECT_EQ(both.labels, (std::vector<Label>{0, -3, 7}));
  EXPECT_EQ(both.labels[both.at_local(left.middle(30))], 7);
  EXPECT_EQ(both.labels[both.at_local(right.middle(30))], -3);
  EXPECT_EQ(command(right, "--label 0"), 2);
}

}  // namespace
}  // namespace cbc3d
