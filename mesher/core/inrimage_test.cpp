// INRIMAGE files in every type and byte order.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesher/core/inrimage.hpp"
#include "mesher/core/testing_files.hpp"

namespace cbc3d {
namespace {

class Inrimage : public testing::Files {};

TEST_F(Inrimage, InrimageIsReadInEveryByteOrder) {
  const auto header = [](const std::string& type) {
    std::string text = "#INRIMAGE-4#{\nXDIM=2\nYDIM=2\nZDIM=1\nVDIM=1\n" + type + "VX=0.5\nVY=0.5\nVZ=2\n";
    text.resize(252, '\n');
    return text + "##}\n";
  };
  write("a.inr",
        header("TYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\n") + std::string("\0\x01\x02\x02", 4));
  write("b.inr",
        header("TYPE=unsigned fixed\nPIXSIZE=16 bits\nCPU=sun\n") + std::string("\0\0\0\x01\0\x02\0\x02", 8));
  for (const char* name : {"a.inr", "b.inr"}) {
    const LabelImage image = read_label_image(file(name));
    EXPECT_EQ(image.labels, (std::vector<Label>{0, 1, 2})) << name;
    ASSERT_EQ(image.voxels.size(), 4U) << name;
    for (const MaterialId expected : {0, 1, 2}) {
      EXPECT_EQ(image.voxels[expected], expected) << name;
    }
    EXPECT_EQ(image.voxels[3], 2) << name;
    EXPECT_EQ(image.frame.spacing_mm, (Vec3{0.5, 0.5, 2})) << name;
  }
  write("c.inr", header("TYPE=unsigned fixed\nPIXSIZE=16 bits\nCPU=sun\n") + "abc");
  EXPECT_NE(why_not_read("c.inr").find("truncated"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d
