#include "mesher/formats/voxel_data.hpp"

#include <random>

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class VoxelData : public testing::Headers {};
using testing::metaimage;
using testing::nifti;
using testing::nrrd;
using testing::packed;

TEST_F(VoxelData, EveryTruncationIsRefused) {
  const std::string plain = nifti(), zipped = packed(nifti()), meta = metaimage(""), raw = nrrd("");
  for (const std::string& whole : {plain, zipped, meta, raw}) {
    EXPECT_EQ(refusal_of("whole", whole), "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
      EXPECT_NE(refusal_of("cut", whole.substr(0, length)), "") << length << " of " << whole.size();
    }
  }
}

TEST_F(VoxelData, WhatFollowsTheLastVoxelIsRefusedUnlessItIsZeros) {
  for (const std::string& whole : {nifti(), packed(nifti() + "x"), packed(nifti()) + packed("more"),
                                   metaimage("") + "x", nrrd("") + "garbage"}) {
    const std::string file = whole == nifti() ? whole + "x" : whole;
    EXPECT_NE(refusal_of("more", file), "");
  }
  expect_refusal("garbage.nii.gz", packed(nifti()) + "garbage", "followed by bytes that are none");
  EXPECT_EQ(refusal_of("padded.nii.gz", packed(nifti()) + std::string(512, '\0')), "");
  ImageHeader header = header_of("padded.nii", nifti() + std::string(512, '\0'));
  require_plausible_length(header);
  ASSERT_EQ(header.warnings.size(), 1U);
  EXPECT_NE(header.warnings[0].find("512 zero bytes"), std::string::npos);
}

TEST_F(VoxelData, OneFlippedBitIsNeverAVoxel) {
  const std::string file = packed(nifti());
  const auto voxels = voxels_of("whole.nii.gz", file);
  std::mt19937 random(7);
  for (int n = 0; n < 500; ++n) {
    std::string damaged = file;
    damaged[10 + random() % (file.size() - 10)] ^= static_cast<char>(1U << random() % 8);
    if (refusal_of("flipped.nii.gz", damaged).empty()) {
      EXPECT_EQ(voxels_of("flipped.nii.gz", damaged), voxels);  // the code has several words for one thing
    }
  }
}

TEST_F(VoxelData, MembersFollowEachOther) {
  const std::string bytes = nifti();
  EXPECT_EQ(voxels_of("two.nii.gz", packed(bytes.substr(0, 360)) + packed(bytes.substr(360))),
            voxels_of("one.nii.gz", packed(bytes)));
}

TEST_F(VoxelData, TextAndHexadecimalValues) {
  const std::string head = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 1\nendian: big\nencoding: ";
  const auto little = voxels_of("t.nrrd", head + "ascii\n\n1 -2\n300,4\n");
  EXPECT_EQ(little, (std::vector<std::uint8_t>{1, 0, 0xFE, 0xFF, 0x2C, 1, 4, 0}));
  EXPECT_EQ(voxels_of("h.nrrd", head + "hex\n\n0001 fffe 012C\n0004"), little);
  expect_refusal("few.nrrd", head + "ascii\n\n1 2 3", "4 values, but the file has 3");
  expect_refusal("many.nrrd", head + "ascii\n\n1 2 3 4 5", "4 values, but the file has 5");
  expect_refusal("word.nrrd", head + "ascii\n\n1 2 x 4", "'x'");
  expect_refusal("large.nrrd", head + "ascii\n\n1 2 3 70000", "'70000'");
  expect_refusal("hex.nrrd", head + "hex\n\n0001 fffe 012C 00", "promises 8 bytes");
}

TEST_F(VoxelData, OffsetInPlaceIsOfRawAlignedVoxels) {
  EXPECT_EQ(offset_in_place(header_of("a.nii", nifti())), 352U);
  EXPECT_FALSE(offset_in_place(header_of("a.nii.gz", packed(nifti()))).has_value());
}

TEST_F(VoxelData, APromiseOfGigabytesIsRefusedBeforeMemoryIsAskedFor) {
  const std::string head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 100000 100000 1000\nencoding: ";
  for (const char* encoding : {"raw", "gzip", "ascii", "hex"}) {
    expect_refusal("huge.nrrd", head + encoding + "\n\nabc", "promises 10000000000000 bytes");
  }
  expect_refusal(
      "endless.nrrd",
      "NRRD0004\ntype: double\ndimension: 3\nsizes: 2000000000 2000000000 2000000000\nencoding: raw\n"
      "endian: little\n\n",
      "more voxels than can be counted");
}

}  // namespace
}  // namespace cbc3d::formats
