// Layers that overlap, volumes of 4-D images and probability maps.
#include "mesher/core/image_volumes.hpp"

#include <cstring>
#include <random>

#include "mesher/core/read_image.hpp"
#include "mesher/core/testing_files.hpp"

namespace cbc3d {
namespace {

using formats::Component;
using formats::ImageHeader;

std::string layered(const std::string& notes, const std::string& voxels, int layers) {
  return "NRRD0005\ntype: uchar\ndimension: 4\nsizes: " + std::to_string(layers) +
         " 4 1 1\nencoding: raw\nspace: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n"
         "space origin: (0,0,0)\nkinds: list domain domain domain\n" +
         notes + "\n" + voxels;
}

std::string segment(int number, const std::string& name, int value, int layer) {
  const std::string key = "Segment" + std::to_string(number) + "_";
  return key + "Name:=" + name + "\n" + key + "LabelValue:=" + std::to_string(value) + "\n" + key +
         "Layer:=" + std::to_string(layer) + "\n";
}

class ImageVolumes : public testing::Files {
 protected:
  [[nodiscard]] LabelImage read(const std::string& name, const ReadImageOptions& options = {}) {
    notes_ = {};
    return read_label_image(file(name), options, notes_);
  }
  [[nodiscard]] std::vector<Label> labels_along_x(const LabelImage& image) const {
    std::vector<Label> labels;
    labels.reserve(image.voxels.size());
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      labels.push_back(image.labels[image.voxels[v]]);
    }
    return labels;
  }
  [[nodiscard]] std::string why_not(const std::string& name, const ReadImageOptions& options) {
    try {
      read_label_image(file(name), options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  ImageNotes notes_;
};

TEST_F(ImageVolumes, TheSegmentThatComesLastHasTheVoxel) {
  // Voxels are pairs of layers: lung alone, lung and tumour, tumour and vessel, nothing.
  write("a.seg.nrrd",
        layered(segment(0, "vessel", 9, 0) + segment(1, "tumour", 4, 1) + segment(2, "lung", 5, 0),
                std::string("\5\0\5\4\11\4\0\0", 8), 2));
  EXPECT_EQ(labels_along_x(read("a.seg.nrrd")), (std::vector<Label>{5, 5, 4, 0}));
  ASSERT_EQ(notes_.warnings.size(), 2U);
  EXPECT_NE(
      notes_.warnings[0].find("2 voxels lie in several segments (tumour (4) over vessel (9), lung (5) over "
                              "tumour (4)); each has the one that comes last"),
      std::string::npos)
      << notes_.warnings[0];
  EXPECT_NE(notes_.warnings[1].find("segments without voxels: vessel (9)"), std::string::npos);
  EXPECT_EQ(notes_.names.text(5), "lung (5)");
  EXPECT_EQ(notes_.names.find(9), nullptr);
}

TEST_F(ImageVolumes, OneLayerIsTakenAlone) {
  write("a.seg.nrrd", layered(segment(0, "lung", 5, 0) + segment(1, "tumour", 4, 1),
                              std::string("\5\0\5\4\0\4\0\0", 8), 2));
  EXPECT_EQ(labels_along_x(read("a.seg.nrrd", {.layer = 1})), (std::vector<Label>{0, 4, 4, 0}));
  EXPECT_TRUE(notes_.warnings.empty());
  EXPECT_EQ(notes_.names.entries().size(), 1U);
  EXPECT_NE(why_not("a.seg.nrrd", {.layer = 2}).find("no layer 2; choose one from 0 to 1"),
            std::string::npos);
  EXPECT_NE(why_not("a.seg.nrrd", {.volume = 0}).find("layer=N"), std::string::npos);
}

TEST_F(ImageVolumes, EqualValuesOfLayersAreNumberedAnew) {
  write("a.seg.nrrd", layered(segment(0, "lung", 1, 0) + segment(1, "tumour", 1, 1),
                              std::string("\1\0\1\1\0\1\2\0", 8), 2));
  const LabelImage image = read("a.seg.nrrd");
  EXPECT_EQ(labels_along_x(image), (std::vector<Label>{1, 2, 2, 3})) << "3 is the value without a segment";
  EXPECT_EQ(notes_.names.text(2), "tumour (2)");
  ASSERT_EQ(notes_.warnings.size(), 2U);
  EXPECT_NE(notes_.warnings[0].find("the same values for different segments"), std::string::npos);
}

TEST_F(ImageVolumes, SegmentsThatCannotBeToldApartAreSaid) {
  const std::string head = "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 4 1 1\nencoding: raw\n";
  write("a.seg.nrrd",
        head + segment(0, "lung", 1, 0) + segment(1, "heart", 1, 0) + segment(2, "far", 2000000000, 0) +
            "Segment3_Name:=far\nSegment3_LabelValue:=9000000000\n\n" + std::string("\1\0\1\0", 4));
  EXPECT_EQ(labels_along_x(read("a.seg.nrrd")), (std::vector<Label>{1, 0, 1, 0}));
  EXPECT_EQ(notes_.names.text(1), "lung (1)");
  std::string all;
  for (const std::string& warning : notes_.warnings) all += warning + "\n";
  EXPECT_NE(all.find("'lung' and 'heart' have one value, 1; the first name is taken"), std::string::npos)
      << all;
  EXPECT_NE(all.find("value 9000000000, which no label can have"), std::string::npos) << all;
}

TEST_F(ImageVolumes, AgreeWithBruteForceOnRandomLayers) {
  std::mt19937 random(7);
  for (int round = 0; round < 20; ++round) {
    ImageHeader header;
    header.size = {5, 4, 3};
    header.volumes = 1 + random() % 4;
    header.volumes_interleaved = random() % 2 == 0;
    header.component = Component::uint8;
    for (std::size_t layer = 0; layer < header.volumes; ++layer) {
      header.segments.push_back(
          {.name = "s", .value = static_cast<int>(layer) + 1, .layer = layer, .colour = {}});
    }
    VoxelBytes bytes(0, formats::voxel_bytes(header));
    std::vector<Label> expected(60, 0);
    for (std::size_t v = 0; v < 60; ++v) {
      for (std::size_t layer = 0; layer < header.volumes; ++layer) {
        const bool there = random() % 2 == 0;
        const std::size_t at = header.volumes_interleaved ? v * header.volumes + layer : layer * 60 + v;
        bytes.data()[at] = there ? static_cast<std::uint8_t>(layer + 1) : 0;
        if (there) expected[v] = static_cast<Label>(layer + 1);
      }
    }
    const FileVoxels voxels(std::move(bytes));
    const std::size_t volume = random() % header.volumes;
    const VoxelBytes one = volume_of(header, voxels, volume);
    const FileVoxels all = combine_layers(header, voxels);
    std::vector<Label> found(60);
    std::memcpy(found.data(), data_of(all), 60 * sizeof(Label));
    EXPECT_EQ(found, expected);
    for (std::size_t v = 0; v < 60; ++v) {
      EXPECT_TRUE(one.data()[v] == 0 || one.data()[v] == volume + 1);
    }
  }
}

TEST_F(ImageVolumes, AVolumeOfA4DImageIsChosen) {
  const std::string head = "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 4 1 1 2\nencoding: raw\n\n";
  write("four.nrrd", head + std::string("\1\0\2\0\0\3\3\0", 8));
  EXPECT_EQ(labels_along_x(read("four.nrrd", {.volume = 1})), (std::vector<Label>{0, 3, 3, 0}));
  EXPECT_NE(why_not("four.nrrd", {}).find("with 2 volumes; volume=N takes one of them, from 0 to 1"),
            std::string::npos);
  EXPECT_NE(why_not("four.nrrd", {.volume = 2}).find("no volume 2"), std::string::npos);
  EXPECT_NE(why_not("four.nrrd", {.layer = 0}).find("no segments"), std::string::npos);
  EXPECT_EQ(read_grey_image(file("four.nrrd"), {.volume = 1}).values, (std::vector<float>{0, 3, 3, 0}));
}

TEST_F(ImageVolumes, ProbabilityMapsAreRefusedWithTheRemedy) {
  const float values[8] = {0, 0.25F, 1, 0, 0.5F, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(values), sizeof values);
  write("p3.nrrd",
        "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n\n" + bytes);
  EXPECT_NE(why_not("p3.nrrd", {}).find("(0.25), a probability map; threshold it"), std::string::npos);
  write("p4.nrrd",
        "NRRD0004\ntype: float\ndimension: 4\nsizes: 2 2 1 2\nencoding: raw\nendian: little\n\n" + bytes);
  EXPECT_NE(why_not("p4.nrrd", {}).find("2 volumes of fractions from 0 to 1, probability maps"),
            std::string::npos);
  EXPECT_NE(why_not("p4.nrrd", {.volume = 0}).find("a probability map"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d
