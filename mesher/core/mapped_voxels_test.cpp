// Uncompressed NRRD files are mapped, and read the same as any other; what cannot be mapped is left alone.
#include "mesher/core/mapped_voxels.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

/// A 5 x 4 x 3 image of 16-bit values 0..59 with this header line among the others.
std::string nrrd(const std::string& line, bool high_byte_first = false) {
  std::string header =
      "NRRD0004\n# two\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 4 3\n"
      "space directions: (1,0,0) (0,2,0) (0,0,3)\nkinds: domain domain domain\n" +
      line + "space origin: (0,0,0)\n";
  header += header.size() % 2 == 0 ? "#x\n\n" : "#\n\n";  // so that values begin at an even byte
  for (int value = 0; value < 60; ++value) {
    const char low = static_cast<char>(value);
    header += high_byte_first ? std::string{'\0', low} : std::string{low, '\0'};
  }
  return header;
}

class Mapped : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / ("cbc3d-mapped-" + std::to_string(::getpid()) + ".nrrd");
  }
  void TearDown() override { fs::remove(file_); }
  void write(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  void expect_counting() const {
    const LabelImage image = read_label_image(file_);
    EXPECT_EQ(image.frame.spacing_mm, (Vec3{1, 2, 3}));
    for (std::size_t v = 0; v < 60; ++v) {
      EXPECT_EQ(image.labels[image.voxels[v]], static_cast<Label>(v));
    }
  }
  fs::path file_;
};

TEST_F(Mapped, RawLittleEndianIsRead) {
  write(nrrd("endian: little\nencoding: raw\n"));
  expect_counting();
}

TEST_F(Mapped, OtherByteOrderIsReadTheOrdinaryWay) {
  write(nrrd("endian: big\nencoding: raw\n", true));
  expect_counting();
}

TEST_F(Mapped, WhatTheFileHasIsMapped) {
  write("0123456789");
  const auto mapped = map_voxels(file_, 4, 6);
  if (!mapped) {
    FAIL() << "not mapped";
  }
  EXPECT_EQ(static_cast<const char*>(mapped->data())[5], '9');
  EXPECT_FALSE(map_voxels(file_, 4, 7).has_value());  // more than there is
  EXPECT_FALSE(map_voxels(file_, 11, 1).has_value());
  EXPECT_FALSE(map_voxels(file_, ~std::uint64_t{0}, 1).has_value());
}

TEST_F(Mapped, TruncatedIsStillRefused) {
  write(nrrd("endian: little\nencoding: raw\n").substr(0, 300));
  EXPECT_THROW(read_label_image(file_), InputError);
}

TEST_F(Mapped, WhatIsNotCompressedAsItsHeaderSaysIsRefused) {
  write(nrrd("endian: little\nencoding: gzip\n"));
  EXPECT_THROW(read_label_image(file_), InputError);
}

}  // namespace
}  // namespace cbc3d
