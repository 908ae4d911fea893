// Slices that are cut short: one line, or the very volume of the whole file.
#include <gtest/gtest.h>
#include <itkBMPImageIO.h>
#include <itkPNGImageIO.h>
#include <itkTIFFImageIO.h>

#include <algorithm>
#include <string>
#include <vector>

#include "mesher/app/testing_command.hpp"
#include "mesher/app/testing_slices.hpp"

namespace cbc3d {
namespace {
using Component = itk::ImageIOBase::IOComponentType;

class TileTruncation : public testing::CommandTest {
 protected:
  [[nodiscard]] testing::Outcome tile(const std::string& name) const {
    std::filesystem::remove(folder_ / "v.nrrd");
    return testing::run_command("tile " + name + " --spacing 1,1,1 --quiet --out v.nrrd", folder_);
  }

  /// Cuts the file at some 60 places and everywhere within its last 8 bytes.
  void expect_cuts_refused(const std::string& name) const {
    const std::string whole = temporary_.content(name);
    ASSERT_EQ(tile(name).exit_code, 0) << name;
    const std::string volume = temporary_.content("v.nrrd");
    const std::size_t step = std::max<std::size_t>(1, whole.size() / 60);
    for (std::size_t length = 1; length < whole.size(); length += length + 8 < whole.size() ? step : 1) {
      const std::string cut = "cut" + std::filesystem::path(name).extension().string();
      temporary_.write(cut, whole.substr(0, length));
      const testing::Outcome outcome = tile(cut);
      if (outcome.exit_code == 0) {
        EXPECT_EQ(temporary_.content("v.nrrd"), volume) << name << " cut at byte " << length;
        continue;
      }
      EXPECT_EQ(outcome.exit_code, 2) << name << " cut at byte " << length;
      EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
      EXPECT_FALSE(std::filesystem::exists(folder_ / "v.nrrd"));
    }
  }
};

TEST_F(TileTruncation, PngAndBmp) {
  std::vector<unsigned char> colours;
  for (const unsigned char value : testing::slice<unsigned char>(1)) {
    colours.insert(colours.end(), {value, value, value});
  }
  testing::write_slice<itk::PNGImageIO>(folder_ / "a.png", testing::slice<unsigned short>(1),
                                        Component::USHORT);
  testing::write_slice<itk::BMPImageIO>(folder_ / "a.bmp", testing::slice<unsigned char>(1),
                                        Component::UCHAR);
  testing::write_slice<itk::BMPImageIO>(folder_ / "c.bmp", colours, Component::UCHAR, 3);
  for (const char* const name : {"a.png", "a.bmp", "c.bmp"}) expect_cuts_refused(name);
}

TEST_F(TileTruncation, TiffOfOnePageAndOfSeveral) {
  testing::write_slice<itk::TIFFImageIO>(folder_ / "a.tif", testing::slice<unsigned short>(1),
                                         Component::USHORT);
  temporary_.write("p.tif", testing::tiff(3, 8, 1, 1));
  for (const char* const name : {"a.tif", "p.tif"}) expect_cuts_refused(name);
}

}  // namespace
}  // namespace cbc3d
