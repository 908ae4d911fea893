// Slices made one volume by `cbc3d tile`.
#include <gtest/gtest.h>
#include <itkBMPImageIO.h>
#include <itkPNGImageIO.h>
#include <itkTIFFImageIO.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using testing::Outcome;

constexpr std::size_t kWidth = 7, kHeight = 5;

template <class Format, class Value>
void write_slice(const fs::path& path, const std::vector<Value>& values,
                 itk::ImageIOBase::IOComponentType type, unsigned channels = 1) {
  auto io = Format::New();
  io->SetNumberOfDimensions(2);
  io->SetDimensions(0, kWidth);
  io->SetDimensions(1, values.size() / kWidth / channels);
  io->SetComponentType(type);
  io->SetPixelType(channels == 1 ? itk::CommonEnums::IOPixel::SCALAR : itk::CommonEnums::IOPixel::RGB);
  io->SetNumberOfComponents(channels);
  io->SetFileName(path.string());
  itk::ImageIORegion region(2);
  region.SetSize(0, kWidth);
  region.SetSize(1, values.size() / kWidth / channels);
  io->SetIORegion(region);
  io->Write(values.data());
}

/// Values that differ from pixel to pixel and from slice to slice.
template <class Value>
std::vector<Value> slice(int k) {
  std::vector<Value> values(kWidth * kHeight);
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = static_cast<Value>(1 + n + 40 * static_cast<std::size_t>(k));
  }
  return values;
}

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
      {"a.png --out v.nrrd --spacing 1,0,1", "--spacing 1,0,1"},
      {"a.png --out v.nrrd --spacing 1,1", "--spacing"}};
  for (const auto& [arguments, says] : faults) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find(says), std::string::npos) << outcome.text;
    EXPECT_FALSE(fs::exists(folder_ / "v.nrrd"));
  }
}

constexpr int kPalette = 3;  // of TIFF's photometric interpretations

/// A TIFF file of pages of 3 x 2 values, each value its number in the file plus one.
std::string tiff(int pages, int bits, int photometric, int format) {
  std::string bytes("II*\0\0\0\0\0", 8);
  const auto put = [&](std::size_t at, std::uint32_t value, std::size_t length) {
    for (std::size_t n = 0; n < length; ++n) {
      bytes[at + n] = static_cast<char>(value >> 8 * n);
    }
  };
  std::size_t link = 4;
  for (int page = 0; page < pages; ++page) {
    const auto strip = static_cast<std::uint32_t>(bytes.size());
    const auto each = static_cast<std::size_t>(bits) / 8;
    bytes.resize(bytes.size() + 6 * each + (6 * each) % 2, '\0');
    for (std::size_t v = 0; v < 6; ++v) {
      put(strip + v * each, static_cast<std::uint32_t>(6 * static_cast<std::size_t>(page) + v + 1), each);
    }
    put(link, static_cast<std::uint32_t>(bytes.size()), 4);
    const auto map = static_cast<std::uint32_t>(bytes.size());
    bytes.resize(bytes.size() + (photometric == kPalette ? 3 * 2 * 256 : 0), '\1');
    if (photometric == kPalette) {
      put(link, static_cast<std::uint32_t>(bytes.size()), 4);
    }
    std::vector<std::array<std::uint32_t, 4>> entries = {{256, 4, 1, 3},
                                                         {257, 4, 1, 2},
                                                         {258, 4, 1, static_cast<std::uint32_t>(bits)},
                                                         {259, 4, 1, 1},
                                                         {262, 4, 1, static_cast<std::uint32_t>(photometric)},
                                                         {273, 4, 1, strip},
                                                         {277, 4, 1, 1},
                                                         {278, 4, 1, 2},
                                                         {279, 4, 1, static_cast<std::uint32_t>(6 * each)},
                                                         {339, 4, 1, static_cast<std::uint32_t>(format)}};
    if (photometric == kPalette) {
      entries.insert(entries.end() - 1, {320, 3, 3 * 256, map});
    }
    std::size_t at = bytes.size();
    bytes.resize(at + 2 + 12 * entries.size() + 4, '\0');
    put(at, static_cast<std::uint32_t>(entries.size()), 2);
    at += 2;
    for (const auto& [tag, type, count, value] : entries) {
      put(at, tag, 2);
      put(at + 2, type, 2);  // 3 and 4: integers of 16 and 32 bits
      put(at + 4, count, 4);
      put(at + 8, value, 4);
      at += 12;
    }
    link = at;
  }
  return bytes;
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
  refuse(tiff(2, 8, 1, 1).substr(0, 12), "broken");
}

}  // namespace
}  // namespace cbc3d
