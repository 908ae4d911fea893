// Voxels in one byte while that is enough, mapped files that are written to in memory only, and offsets
// beyond 32 bits.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/label_voxels.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;

TEST(LabelVoxels, WidenWhenOneByteIsTooLittle) {
  LabelVoxels voxels(1000);
  voxels[7] = 255;
  EXPECT_FALSE(voxels.is_wide());
  EXPECT_EQ(voxels.bytes(), 1000U);
  voxels[8] = 256;
  EXPECT_TRUE(voxels.is_wide());
  EXPECT_EQ(voxels.bytes(), 2000U);
  EXPECT_EQ(voxels[7], 255);
  EXPECT_EQ(voxels[8], 256);
  EXPECT_EQ(voxels[9], 0);
  LabelVoxels other(1000);
  other.hold(256);
  EXPECT_FALSE(other.is_wide());
  other.hold(257);
  EXPECT_TRUE(other.is_wide());
}

TEST(LabelVoxels, AreEqualByWhatTheyHold) {
  LabelVoxels narrow(3), wide(3);
  wide.hold(1000);
  narrow[1] = wide[1] = 200;
  EXPECT_EQ(narrow, wide);
  wide[2] = 256;
  EXPECT_FALSE(narrow == wide);
  EXPECT_FALSE(LabelVoxels(2) == LabelVoxels(3));
  LabelVoxels copy = wide;
  copy[0] = 1;
  EXPECT_EQ(wide[0], 0);
  const LabelVoxels moved = std::move(copy);
  EXPECT_EQ(moved[0], 1);
  EXPECT_EQ(moved[2], 256);
}

class MappedLabels : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / ("cbc3d-labels-" + std::to_string(::getpid()) + ".nrrd");
  }
  void TearDown() override { fs::remove(file_); }
  [[nodiscard]] std::size_t write(const Index3& size, const std::string& voxels) const {
    const std::string header =
        "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: " +
        std::to_string(size[0]) + " " + std::to_string(size[1]) + " " + std::to_string(size[2]) +
        "\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nkinds: domain domain domain\nencoding: raw\n"
        "space origin: (0,0,0)\n\n";
    std::ofstream(file_, std::ios::binary) << header << voxels;
    return header.size();
  }
  [[nodiscard]] std::string content() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path file_;
};

TEST_F(MappedLabels, AreWrittenInMemoryOnly) {
  static_cast<void>(write({4, 2, 1}, std::string{0, 1, 2, 3, 3, 2, 1, 0}));
  const std::string before = content();
  LabelImage image = read_label_image(file_);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 1, 2, 3}));
  const LabelImage copy = image;
  image.voxels[0] = 3;
  image.voxels[7] = 300;
  EXPECT_EQ(image.voxels[0], 3);
  EXPECT_EQ(image.voxels[7], 300);
  EXPECT_EQ(copy.voxels[0], 0);
  EXPECT_EQ(copy.voxels[7], 0);
  EXPECT_EQ(content(), before);
}

TEST_F(MappedLabels, WithGapsGetMaterialsOfTheirOwn) {
  static_cast<void>(write({4, 2, 1}, std::string{0, 1, '\x80', 9, 9, 1, 0, '\xff'}));
  const LabelImage image = read_label_image(file_);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 1, 9, 128, 255}));
  EXPECT_FALSE(image.voxels.is_wide());
  EXPECT_EQ(image.at(2, 0, 0), 3);
  EXPECT_EQ(image.at(3, 1, 0), 4);
}

/// More voxels than 32 bits can number, in a file without content: only what is looked at exists.
TEST_F(MappedLabels, BeyondFourThousandMillion) {
  LabelImage image;
  image.frame.size = {65536, 65539, 1};
  image.labels = {0, 1};
  const std::size_t count = image.frame.voxel_count();
  ASSERT_EQ(count, 4295163904U);
  const std::size_t begin = write(image.frame.size, "");
  fs::resize_file(file_, begin + count);
  auto mapped = map_voxels(file_, begin, count);
  if (!mapped) {
    FAIL() << "not mapped";
  }
  image.voxels = LabelVoxels(std::move(*mapped), count);
  const std::size_t last = image.frame.offset(65535, 65538, 0), before = image.frame.offset(7, 65537, 0);
  EXPECT_EQ(last, count - 1);
  EXPECT_EQ(image.frame.index_of(before), (Index3{7, 65537, 0}));
  image.voxels.set(last, 1);
  image.voxels.set(before, 1);
  EXPECT_EQ(image.at(65535, 65538, 0), 1);
  EXPECT_EQ(image.at_or_background(7, 65537, 0), 1);
  EXPECT_EQ(image.at(7, 1, 0), 0);  // where a 32-bit offset would have landed
  EXPECT_EQ(image.at(65535, 2, 0), 0);
  std::vector<int> found;
  BoundaryRows(image).find(65537, 0, found);
  EXPECT_EQ(found, std::vector<int>{7});
}

}  // namespace
}  // namespace cbc3d
