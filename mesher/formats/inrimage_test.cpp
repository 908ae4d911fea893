#include "mesher/formats/inrimage.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Inrimage : public testing::Headers {};
using testing::packed;

std::string inrimage(const std::string& fields, const std::string& voxels) {
  std::string text = "#INRIMAGE-4#{\n" + fields;
  text.resize(252, '\n');
  return text + "##}\n" + voxels;
}

const std::string kSize = "XDIM=2\nYDIM=2\nZDIM=1\nVDIM=1\n";

TEST_F(Inrimage, EveryByteOrderPlainAndCompressed) {
  const std::string little =
      inrimage(kSize + "TYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\nVX=0.5\nVZ=2\nTX=3\n",
               std::string("\0\x01\x02\x02", 4));
  const ImageHeader header = header_of("a.inr", little);
  EXPECT_EQ(header.spacing_mm, (Triple{0.5, 1, 2}));
  EXPECT_EQ(header.origin_mm, (Triple{3, 0, 0}));
  EXPECT_EQ(voxels_of("b.inr.gz", packed(little)), (std::vector<std::uint8_t>{0, 1, 2, 2}));
  const std::string big = inrimage(kSize + "TYPE=unsigned fixed\nPIXSIZE=16 bits\nCPU=sun\n",
                                   std::string("\0\0\0\x01\0\x02\0\x02", 8));
  EXPECT_EQ(voxels_of("c.inr", big), (std::vector<std::uint8_t>{0, 0, 1, 0, 2, 0, 2, 0}));
}

TEST_F(Inrimage, DamageIsNamed) {
  const std::string type = "TYPE=unsigned fixed\nPIXSIZE=8 bits\n";
  expect_refusal("a.inr", inrimage("XDIM=8.9\n" + type, ""), "'8.9'");
  expect_refusal("b.inr", inrimage(kSize + type + "TX=nan\n", "abcd"), "'nan'");
  expect_refusal("c.inr", inrimage(kSize + type + "VX=nan\n", "abcd"), "'nan'");
  expect_refusal("d.inr", inrimage(kSize + type + "VX=1e-300\n", "abcd"), "spacing");
  expect_refusal("e.inr",
                 inrimage("XDIM=1073741824\nYDIM=1073741824\nZDIM=2\nTYPE=float\nPIXSIZE=64 bits\n", ""),
                 "more voxels than can be counted");
  expect_refusal("f.inr", inrimage(kSize + "TYPE=float\nPIXSIZE=16 bits\n", "abcd"), "PIXSIZE=16");
  expect_refusal("g.inr", inrimage("XDIM=2\nVDIM=3\n" + type, "abcd"), "VDIM=3");
  expect_refusal("h.inr", "#INRIMAGE-4#{\nXDIM=2\n", "does not end");
}

}  // namespace
}  // namespace cbc3d::formats
