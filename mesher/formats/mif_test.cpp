#include "mesher/formats/mif.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Mif : public testing::Headers {};
using testing::packed;

std::string mif(const std::string& layout, const std::string& lines = "") {
  std::string head = "mrtrix image\ndim: 2,3,4\nvox: 1,2,3\nlayout: " + layout +
                     "\ndatatype: UInt8\ntransform: 1,0,0,10\ntransform: 0,1,0,20\ntransform: 0,0,1,30\n" +
                     lines;
  head += "file: . 512\nEND\n";
  head.resize(512, '\0');
  for (int v = 0; v < 24; ++v) {
    head += static_cast<char>(v);
  }
  return head;
}

TEST_F(Mif, TheImageAxesAreTheStorageAxes) {
  const ImageHeader plain = header_of("a.mif", mif("+0,+1,+2"));
  EXPECT_EQ(plain.size, (std::array<std::size_t, 3>{2, 3, 4}));
  EXPECT_EQ(plain.origin_mm, (Triple{-10, -20, 30}));
  EXPECT_EQ(plain.axes[1], (Triple{0, -1, 0}));
  // Slowest along x, whose voxels are stored backwards; fastest along z.
  const ImageHeader turned = header_of("b.mif", mif("-2,+1,+0"));
  EXPECT_EQ(turned.size, (std::array<std::size_t, 3>{4, 3, 2}));
  EXPECT_EQ(turned.spacing_mm, (Triple{3, 2, 1}));
  EXPECT_EQ(turned.axes[0], (Triple{0, 0, 1}));
  EXPECT_EQ(turned.axes[2], (Triple{1, 0, 0}));
  EXPECT_EQ(turned.origin_mm, (Triple{-11, -20, 30}));
  EXPECT_EQ(voxels_of("c.mif.gz", packed(mif("+0,+1,+2")))[7], 7);
}

TEST_F(Mif, DamageIsNamed) {
  expect_refusal("a.mif", mif("+0,+1,+1"), "layout");
  expect_refusal("b.mif", mif("0,1,2"), "layout");
  expect_refusal("c.mif", mif("+0,+1,+2").substr(0, 520), "truncated");
  expect_refusal("d.mif", "mrtrix image\ndim: 2,3,4\n", "END");
  expect_refusal("e.mif", mif("+0,+1,+2", "transform: 0,0,1\n"), "15 numbers");
  expect_refusal("f.mif", mif("+0,+1,+2", "vox: 1,1,1\n"), "'vox'");
}

}  // namespace
}  // namespace cbc3d::formats
