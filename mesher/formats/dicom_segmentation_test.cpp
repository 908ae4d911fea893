#include "mesher/formats/dicom_segmentation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mesher/formats/testing_dicom.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::formats {
namespace {

using testing::DicomSegmentationFile;
using testing::DicomWriter;

class DicomSeg : public ::testing::Test {
 protected:
  [[nodiscard]] DicomSegmentation read(const std::string& bytes) const {
    folder_.write("a.dcm", bytes);
    return read_dicom_segmentation(folder_.file("a.dcm"));
  }
  [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
    try {
      static_cast<void>(read(bytes));
    } catch (const FormatError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }
  void expect_refusal(const DicomSegmentationFile& file, const std::string& words) const {
    EXPECT_NE(refusal_of(file.bytes()).find(words), std::string::npos) << refusal_of(file.bytes());
  }
  cbc3d::testing::TemporaryFolder folder_{"dicom"};
};

TEST_F(DicomSeg, FramesBecomeAVolumeAndOverlapsAreCounted) {
  for (const bool is_explicit : {true, false}) {
    const DicomSegmentation seg = read(testing::segmentation().bytes(DicomWriter(is_explicit, !is_explicit)));
    EXPECT_EQ(seg.header.format, "DICOM SEG");
    EXPECT_EQ(seg.header.size, (std::array<std::size_t, 3>{3, 2, 4}));
    EXPECT_EQ(seg.header.spacing_mm, (Triple{0.25, 0.5, 2}));
    EXPECT_EQ(seg.header.origin_mm, (Triple{10, 20, 30}));
    EXPECT_EQ(seg.labels, (std::vector<std::uint16_t>{1, 0, 0, 1, 1, 0, 1, 2, 2, 0, 0, 0,  //
                                                      0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2}));
    ASSERT_EQ(seg.header.warnings.size(), 1U);
    EXPECT_EQ(seg.header.warnings[0],
              "1 voxels are in several segments; each has the highest number of them");
  }
}

TEST_F(DicomSeg, FramesInAnyOrderAreTheSameVolume) {
  auto file = testing::segmentation();
  const auto labels = read(file.bytes()).labels;
  std::reverse(file.frames.begin(), file.frames.end());
  EXPECT_EQ(read(file.bytes()).labels, labels);
  std::swap(file.frames[0], file.frames[2]);
  const DicomSegmentation seg = read(file.bytes());
  EXPECT_EQ(seg.labels, labels);
  EXPECT_EQ(seg.header.origin_mm, (Triple{10, 20, 30}));
}

TEST_F(DicomSeg, ObliqueFramesLieAlongTheirNormal) {
  auto file = testing::segmentation();
  file.orientation = "0\\1\\0\\0\\0\\-1";  // sagittal: the normal is -x
  for (std::size_t f = 0; f < file.frames.size(); ++f) {
    file.frames[f].position = std::to_string(5 - 3 * static_cast<int>(f)) + "\\1\\2";
  }
  file.between = "3";
  const DicomSegmentation seg = read(file.bytes());
  EXPECT_EQ(seg.header.axes[0], (Triple{0, 1, 0}));
  EXPECT_EQ(seg.header.axes[1], (Triple{0, 0, -1}));
  EXPECT_EQ(seg.header.axes[2], (Triple{-1, 0, 0}));
  EXPECT_EQ(seg.header.origin_mm, (Triple{5, 1, 2}));
  EXPECT_EQ(seg.header.size[2], 4U);
  EXPECT_EQ(seg.header.spacing_mm[2], 3);
}

TEST_F(DicomSeg, SpacingOfSlicesIsThatOfTheFramesWhereTheFileSaysAnother) {
  auto file = testing::segmentation();
  for (const char* between : {"", "5", "0"}) {  // a thickness of 7 mm stands beside
    file.between = between;
    EXPECT_EQ(read(file.bytes()).header.spacing_mm[2], 2) << between;
  }
}

TEST_F(DicomSeg, WhatIsNoBinarySegmentationIsNamed) {
  const auto with = [](auto change) {
    auto file = testing::segmentation();
    change(file);
    return file;
  };
  using File = DicomSegmentationFile;
  expect_refusal(with([](File& f) { f.sop_class = "1.2.840.10008.5.1.4.1.1.2", f.modality = "CT"; }),
                 "modality 'CT', no segmentation");
  expect_refusal(
      with([](File& f) { f.sop_class = "1.2.840.10008.5.1.4.1.1.481.3", f.modality = "RTSTRUCT"; }),
      "structure set");
  expect_refusal(with([](File& f) { f.sop_class = "1.2.840.10008.5.1.4.1.1.66.7"; }), "label map");
  expect_refusal(with([](File& f) { f.type = "FRACTIONAL", f.bits = 8; }), "fractional");
  expect_refusal(with([](File& f) { f.bits = 8; }), "8 bits per voxel");
  expect_refusal(with([](File& f) { f.syntax = "1.2.840.10008.1.2.1.99"; }), "deflated");
}

TEST_F(DicomSeg, ImpossibleFramesAreRefused) {
  const auto with = [](auto change) {
    auto file = testing::segmentation();
    change(file);
    return file;
  };
  using File = DicomSegmentationFile;
  expect_refusal(with([](File& f) { f.frames[1].position = "10\\20\\31"; }), "");  // every 1 mm
  expect_refusal(with([](File& f) { f.frames[1].position = "10\\20\\32.7"; }), "not evenly spaced");
  expect_refusal(with([](File& f) { f.frames[1].position = "10\\21\\32"; }), "sideways");
  expect_refusal(with([](File& f) { f.frames[3].position = "10\\20\\900000"; }), "mm apart");
  expect_refusal(with([](File& f) { f.frames[3].position = "10\\20"; }), "ImagePositionPatient");
  expect_refusal(with([](File& f) { f.frames[3].position = "nan\\0\\0"; }), "ImagePositionPatient");
  expect_refusal(with([](File& f) { f.frames[3].position = ""; }), "has no ImagePositionPatient");
  expect_refusal(with([](File& f) { f.frames[3].segment = 9; }), "segment 9");
  expect_refusal(with([](File& f) { f.orientation = "1\\0\\0\\1\\0\\0"; }), "perpendicular");
  expect_refusal(with([](File& f) { f.spacing = "0\\1"; }), "spacing");
  expect_refusal(with([](File& f) { f.rows = 0; }), "Rows");
  expect_refusal(with([](File& f) { f.rows = f.columns = 65535; }), "promises");
  expect_refusal(with([](File& f) { f.frame_count = "5"; }), "NumberOfFrames is 5, but 4");
  expect_refusal(with([](File& f) { f.frame_count = "many"; }), "NumberOfFrames");
}

TEST_F(DicomSeg, ASingleFrameNeedsADistanceOfSlices) {
  auto file = testing::segmentation();
  file.frames.resize(1);
  EXPECT_EQ(read(file.bytes()).header.spacing_mm[2], 2);
  file.between = "";
  EXPECT_EQ(read(file.bytes()).header.spacing_mm[2], 7);  // the slice thickness
}

TEST_F(DicomSeg, ChangedBytesAreAVolumeOrOneLine) {
  const std::string whole = testing::segmentation().bytes();
  std::mt19937 draw(7);
  for (int n = 0; n < 2000; ++n) {
    std::string bytes = whole;
    for (int change = 0; change < 3; ++change) {
      bytes[132 + draw() % (bytes.size() - 132)] = static_cast<char>(draw());
    }
    static_cast<void>(refusal_of(n % 2 == 0 ? bytes : bytes.substr(0, 132 + draw() % (bytes.size() - 132))));
  }
}

}  // namespace
}  // namespace cbc3d::formats
