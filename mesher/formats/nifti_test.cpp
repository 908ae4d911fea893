#include "mesher/formats/nifti.hpp"

#include <cmath>
#include <limits>

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Nifti : public testing::Headers {};
using testing::nifti;
using testing::packed;
using testing::put;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST_F(Nifti, SformInEitherByteOrderBecomesLps) {
  for (const bool big : {false, true}) {
    const ImageHeader header = header_of("a.nii", nifti(big));
    EXPECT_EQ(header.format, "NIfTI-1");
    EXPECT_EQ(header.size, (std::array<std::size_t, 3>{2, 3, 4}));
    EXPECT_EQ(header.spacing_mm, (Triple{0.5, 1, 1.5}));
    EXPECT_EQ(header.origin_mm, (Triple{-10, -20, 30}));
    EXPECT_EQ(header.axes[0], (Triple{-1, 0, 0}));
    EXPECT_EQ(header.axes[1], (Triple{0, -1, 0}));
    EXPECT_EQ(header.axes[2], (Triple{0, 0, 1}));
    EXPECT_TRUE(header.warnings.empty());
  }
}

TEST_F(Nifti, UnitsScaleSpacingAndOrigin) {
  for (const auto& [unit, mm] : {std::pair{1, 1000.0}, std::pair{3, 0.001}}) {
    std::string bytes = nifti();
    bytes[123] = static_cast<char>(unit + 8);  // and seconds
    const ImageHeader header = header_of("a.nii", bytes);
    EXPECT_DOUBLE_EQ(header.spacing_mm[2], 1.5 * mm);
    EXPECT_DOUBLE_EQ(header.origin_mm[2], 30 * mm);
  }
}

TEST_F(Nifti, WithoutSformTheQformRulesAndWithoutBothThereIsAWarning) {
  std::string bytes = nifti();
  put(bytes, 254, std::int16_t{0});
  put(bytes, 252, std::int16_t{1});
  put(bytes, 76, -1.0F);  // the third axis is turned
  put(bytes, 264, 1.0F);  // half a turn around z
  put(bytes, 268, 7.0F);
  const ImageHeader turned = header_of("a.nii", bytes);
  EXPECT_EQ(turned.axes[0], (Triple{1, 0, 0}));
  EXPECT_EQ(turned.axes[2], (Triple{0, 0, -1}));
  EXPECT_EQ(turned.origin_mm, (Triple{-7, 0, 0}));
  put(bytes, 252, std::int16_t{0});
  const ImageHeader none = header_of("a.nii", bytes);
  ASSERT_EQ(none.warnings.size(), 1U);
  EXPECT_NE(none.warnings[0].find("neither qform nor sform"), std::string::npos);
  EXPECT_EQ(none.axes[0], (Triple{-1, 0, 0}));
}

TEST_F(Nifti, TwoFramesThatDifferAreTold) {
  std::string bytes = nifti();
  put(bytes, 252, std::int16_t{1});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 268 + 4 * axis, 10.0F * static_cast<float>(axis + 1));
  }
  EXPECT_TRUE(header_of("same.nii", bytes).warnings.empty());
  put(bytes, 268, 10.04F);
  EXPECT_TRUE(header_of("near.nii", bytes).warnings.empty());  // less than a tenth of a voxel
  put(bytes, 268, 11.0F);
  const ImageHeader header = header_of("far.nii", bytes);
  ASSERT_EQ(header.warnings.size(), 1U);
  EXPECT_NE(header.warnings[0].find("up to 1 mm apart"), std::string::npos) << header.warnings[0];
  EXPECT_EQ(header.origin_mm[0], -10);
}

TEST_F(Nifti, SlopeOfZeroIsUnset) {
  std::string bytes = nifti();
  put(bytes, 116, 5.0F);
  EXPECT_EQ(header_of("a.nii", bytes).intercept, 0);
  put(bytes, 112, 2.0F);
  const ImageHeader header = header_of("a.nii", bytes);
  EXPECT_EQ(header.slope, 2);
  EXPECT_EQ(header.intercept, 5);
  put(bytes, 112, kNan);
  EXPECT_EQ(header_of("a.nii", bytes).warnings.size(), 1U);
}

TEST_F(Nifti, CompressedUnderAnyName) {
  const auto voxels = voxels_of("a.nii", nifti());
  EXPECT_EQ(voxels.size(), 24U);
  EXPECT_EQ(voxels[7], 2);
  EXPECT_EQ(voxels_of("b.nii", packed(nifti())), voxels);
  EXPECT_EQ(voxels_of("c.nii.gz", nifti()), voxels);
}

TEST_F(Nifti, APairHasItsVoxelsBeside) {
  std::string header = nifti().substr(0, 352);
  header.replace(344, 4, std::string("ni1\0", 4));
  put(header, 108, 0.0F);
  folder_.write("p.img", nifti().substr(352));
  EXPECT_EQ(voxels_of("p.hdr", header)[7], 2);
  EXPECT_EQ(read_image_header(folder_.file("p.img")).format, "NIfTI-1");
  header.replace(344, 4, std::string(4, '\0'));  // Analyze
  const ImageHeader analyze = header_of("p.hdr", header);
  EXPECT_EQ(analyze.format, "Analyze 7.5");
  EXPECT_EQ(analyze.axes[0], (Triple{1, 0, 0}));
  EXPECT_EQ(analyze.origin_mm, (Triple{-0.25, 1, -2.25}));
  EXPECT_EQ(analyze.warnings.size(), 1U);
  folder_.write("p.img", nifti().substr(353));
  expect_refusal("p.hdr", header, "truncated");
}

TEST_F(Nifti, Version2) {
  std::string bytes(544, '\0');
  put(bytes, 0, std::int32_t{540});
  bytes.replace(4, 8, std::string("n+2\0\r\n\032\n", 8));
  put(bytes, 12, std::int16_t{2});
  put(bytes, 14, std::int16_t{8});
  put(bytes, 16, std::int64_t{3});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 24 + 8 * axis, static_cast<std::int64_t>(2 + axis));
    put(bytes, 112 + 8 * axis, 0.5 * static_cast<double>(axis + 1));
  }
  put(bytes, 168, std::int64_t{544});
  put(bytes, 344, std::int32_t{1});
  put(bytes, 376, 7.0);
  const std::string file = bytes + nifti().substr(352);
  const ImageHeader header = header_of("a.nii", file);
  EXPECT_EQ(header.format, "NIfTI-2");
  EXPECT_EQ(header.origin_mm[0], -7);
  EXPECT_EQ(voxels_of("b.nii.gz", packed(file))[7], 2);
  put(bytes, 24, std::int64_t{1} << 40U);
  expect_refusal("huge.nii", bytes, "not a number of voxels");
  bytes[8] = '\n';
  expect_refusal("text.nii", bytes, "signature is damaged");
}

TEST_F(Nifti, WhatCannotBeIsRefused) {
  const auto with = [](std::size_t at, auto value) {
    std::string bytes = nifti();
    put(bytes, at, value);
    return bytes;
  };
  expect_refusal("a.nii", with(280, kNan), "sform has an entry that is no finite number");
  expect_refusal("b.nii", with(292, std::numeric_limits<float>::infinity()), "no finite number");
  expect_refusal("c.nii", with(280, 0.0F), "no direction");
  expect_refusal("d.nii", with(42, std::int16_t{-2}), "dim[1]");
  expect_refusal("e.nii", with(40, std::int16_t{9}), "9 dimensions");
  expect_refusal("f.nii", with(40, std::int16_t{2}), "2-dimensional");
  expect_refusal("g.nii", with(72, std::int16_t{16}), "at odds with itself");
  expect_refusal("h.nii", with(70, std::int16_t{128}), "RGB");
  expect_refusal("i.nii", with(108, kNan), "vox_offset");
  expect_refusal("j.nii", with(108, 100.0F), "vox_offset");
  expect_refusal("k.nii", with(42, std::int16_t{30000}), "truncated");
  std::string volumes = with(40, std::int16_t{4});
  put(volumes, 48, std::int16_t{3});
  EXPECT_EQ(header_of("l.nii", volumes).volumes, 3U);
  expect_refusal("l.nii", volumes, "promises 72 bytes");
  std::string spacing = with(254, std::int16_t{0});
  put(spacing, 252, std::int16_t{1});
  put(spacing, 80, 0.0F);
  expect_refusal("m.nii", spacing, "pixdim[1] = 0");
  put(spacing, 80, 1e-30F);
  expect_refusal("n.nii", spacing, "spacing");
}

}  // namespace
}  // namespace cbc3d::formats
