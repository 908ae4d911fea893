// Slices made one volume by `cbc3d tile`.
#include <gtest/gtest.h>
#include <itkBMPImageIO.h>
#include <itkPNGImageIO.h>
#include <itkTIFFImageIO.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesher/app/testing_command.hpp"
#include "mesher/app/testing_slices.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using testing::Outcome;

using testing::kHeight, testing::kPalette, testing::kWidth, testing::slice, testing::tiff,
    testing::write_slice;

class Tile : public testing::CommandTest {
 protected:
  /// With the folder of the files as the working directory.
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return testing::run_command("tile " + arguments + " --quiet", folder_);
  }
  void expect_volume(const std::string& name) const {
    const LabelImage volume = read_label_image(folder_ / name);
    EXPECT_EQ(volume.frame.size, (Index3{7, 5, 3}));
    EXPECT_EQ(volume.frame.spacing_mm, (Vec3{.012, .013, .024}));
    EXPECT_EQ(volume.frame.origin_mm, (Vec3{1, -2, 3}));
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j < 5; ++j) {
        for (int i = 0; i < 7; ++i) {
          EXPECT_EQ(volume.labels[volume.at(i, j, k)], 1 + i + 7 * j + 40 * k);
        }
      }
    }
  }
};

const std::string kPlace = " --spacing .012,.013,.024 --origin 1,-2,3";

TEST_F(Tile, EveryFormatToEveryFormat) {
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k);
    write_slice<itk::PNGImageIO>(folder_ / (number + ".png"), slice<unsigned char>(k),
                                 itk::ImageIOBase::IOComponentType::UCHAR);
    write_slice<itk::BMPImageIO>(folder_ / (number + ".bmp"), slice<unsigned char>(k),
                                 itk::ImageIOBase::IOComponentType::UCHAR);
    write_slice<itk::TIFFImageIO>(folder_ / (number + ".tif"), slice<unsigned short>(k),
                                  itk::ImageIOBase::IOComponentType::USHORT);
    write_slice<itk::PNGImageIO>(folder_ / (number + "w.png"), slice<unsigned short>(k),
                                 itk::ImageIOBase::IOComponentType::USHORT);
  }
  for (const std::string slices :
       {"0.png 1.png 2.png", "0.bmp 1.bmp 2.bmp", "0.tif 1.tif 2.tif", "0w.png 1w.png 2w.png"}) {
    for (const std::string out : {"v.nrrd", "v.mha"}) {
      const Outcome outcome = run(slices + " --out " + out + kPlace);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
      expect_volume(out);
    }
  }
}

TEST_F(Tile, GreyInColourIsTakenColourIsNot) {
  std::vector<unsigned char> grey, colour;
  for (const unsigned char value : slice<unsigned char>(0)) {
    grey.insert(grey.end(), {value, value, value});
    colour.insert(colour.end(), {value, value, 3});
  }
  write_slice<itk::BMPImageIO>(folder_ / "grey.bmp", grey, itk::ImageIOBase::IOComponentType::UCHAR, 3);
  write_slice<itk::PNGImageIO>(folder_ / "colour.png", colour, itk::ImageIOBase::IOComponentType::UCHAR, 3);
  ASSERT_EQ(run("grey.bmp --out v.nrrd --spacing 1,1,1").exit_code, 0);
  EXPECT_EQ(read_label_image(folder_ / "v.nrrd").labels.size(), 1 + kWidth * kHeight);
  const Outcome refused = run("colour.png --out c.nrrd --spacing 1,1,1");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.text.find("colour"), std::string::npos) << refused.text;
  EXPECT_NE(refused.text.find("--luminance"), std::string::npos) << refused.text;
  ASSERT_EQ(run("colour.png --luminance -o c.nrrd --spacing 1,1,1").exit_code, 0);
  const LabelImage volume = read_label_image(folder_ / "c.nrrd");
  const double value = slice<unsigned char>(0)[8];
  EXPECT_EQ(volume.labels[volume.voxels[8]], std::lround(0.886 * value + 0.114 * 3));
}

TEST_F(Tile, NamesThatDoNotCountUpwardsAreSaid) {
  for (const int k : {1, 2, 10}) {
    write_slice<itk::PNGImageIO>(folder_ / ("s" + std::to_string(k) + ".png"),
                                 slice<unsigned char>(k == 10 ? 2 : k - 1),
                                 itk::ImageIOBase::IOComponentType::UCHAR);
  }
  const Outcome shell = run("s1.png s10.png s2.png -o shell.nrrd" + kPlace);
  EXPECT_EQ(shell.exit_code, 0);
  EXPECT_NE(shell.text.find("'s2.png' comes after 's10.png' in the order given"), std::string::npos)
      << shell.text;
  EXPECT_NE(shell.text.find("--natural-order"), std::string::npos);
  const Outcome sorted = run("s1.png s10.png s2.png --natural-order -o sorted.nrrd" + kPlace);
  EXPECT_EQ(sorted.text, "");
  expect_volume("sorted.nrrd");
}

TEST_F(Tile, OneLineForWhatIsWrongAndNoFile) {
  write_slice<itk::PNGImageIO>(folder_ / "a.png", slice<unsigned char>(0),
                               itk::ImageIOBase::IOComponentType::UCHAR);
  std::vector<unsigned char> shorter = slice<unsigned char>(0);
  shorter.resize(kWidth * 3);
  write_slice<itk::PNGImageIO>(folder_ / "b.png", shorter, itk::ImageIOBase::IOComponentType::UCHAR);
  std::ofstream(folder_ / "c.png") << "no image";
  const std::vector<std::pair<std::string, std::string>> faults{
      {"a.png b.png --out v.nrrd --spacing 1,1,1", "'b.png': it has 7 x 3"},
      {"a.png c.png --out v.nrrd --spacing 1,1,1", "'c.png': not a PNG"},
      {"a.png d.png --out v.nrrd --spacing 1,1,1", "'d.png': no such file"},
      {"a.png --out v.nii.gz --spacing 1,1,1", "v.nii.gz"},
      {"a.png --out v.nrrd --spacing 1,0,1", "--spacing: 0: give a number from"},
      {"a.png --out v.nrrd --spacing 1,1", "--spacing"}};
  for (const auto& [arguments, says] : faults) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find(says), std::string::npos) << outcome.text;
    EXPECT_FALSE(fs::exists(folder_ / "v.nrrd"));
  }
}

TEST_F(Tile, PagesOfEveryWidthAreSlices) {
  for (const int bits : {8, 16, 32}) {
    for (const int format : {1, 2}) {
      std::ofstream(folder_ / "p.tif", std::ios::binary) << tiff(4, bits, 1, format);
      const auto outcome =
          testing::run_command("tile " + at("p.tif") + " --spacing 1,1,1 --quiet --out " + at("p.nrrd"));
      ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
      const LabelImage volume = read_label_image(folder_ / "p.nrrd");
      EXPECT_EQ(volume.frame.size, (Index3{3, 2, 4}));
      for (std::size_t v = 0; v < 24; ++v) {
        EXPECT_EQ(volume.labels[volume.voxels[v]], static_cast<Label>(v + 1)) << bits;
      }
    }
  }
}

TEST_F(Tile, TiffThatHoldsNoGreyValuesIsNamed) {
  const auto refuse = [&](const std::string& bytes, const char* words) {
    std::ofstream(folder_ / "bad.tif", std::ios::binary) << bytes;
    expect_refusal("tile " + at("bad.tif") + " --spacing 1,1,1 --out " + at("bad.nrrd"), words, "bad.nrrd");
  };
  refuse(tiff(1, 8, kPalette, 1), "palette");
  refuse(tiff(1, 8, 0, 1), "inverted");
  refuse(tiff(1, 32, 1, 6), "32 bits (sample format 6)");
  refuse(tiff(2, 8, 1, 1).substr(0, 12), "truncated");
}

}  // namespace
}  // namespace cbc3d
