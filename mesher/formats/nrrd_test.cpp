#include "mesher/formats/nrrd.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Nrrd : public testing::Headers {};
using testing::nrrd;
using testing::packed;

const std::string kFrame =
    "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";

TEST_F(Nrrd, EncodingsAndDetachedFiles) {
  const std::string voxels = nrrd("").substr(nrrd("").size() - 24);
  const auto plain = voxels_of("a.nrrd", nrrd(kFrame));
  const std::string head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 3 4\n" + kFrame + "encoding: ";
  EXPECT_EQ(voxels_of("z.nrrd", head + "gzip\n\n" + packed(voxels)), plain);
  folder_.write("v.raw", "two\nlines\n--" + voxels);
  EXPECT_EQ(voxels_of("d.nhdr", head + "raw\ndata file: v.raw\nline skip: 2\nbyte skip: 2\n"), plain);
  EXPECT_EQ(voxels_of("e.nhdr", head + "raw\nbyte skip: -1\ndatafile: v.raw\n"), plain);
  folder_.write("s1.raw", voxels.substr(0, 12));
  folder_.write("s2.raw", voxels.substr(12));
  EXPECT_EQ(voxels_of("p.nhdr", head + "raw\ndata file: s%d.raw 1 2 1\n"), plain);
  EXPECT_EQ(voxels_of("l.nhdr", head + "raw\ndata file: LIST\ns1.raw\ns2.raw\n"), plain);
  expect_refusal("n.nhdr", head + "raw\ndata file: absent.raw\n", "absent.raw");
}

TEST_F(Nrrd, DamageIsNamed) {
  expect_refusal("long.nrrd", "NRRD0004\nspace: " + std::string(70000, 'x') + "\n\n", "65536 characters");
  expect_refusal("space.nrrd", nrrd("space: " + std::string(4000, 'x') + "\n"), "its space is 'xxx");
  expect_refusal("type.nrrd", "NRRD0004\ntype: block\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\na",
                 "'block'");
  expect_refusal("twice.nrrd", nrrd("type: uchar\n"), "twice");
  expect_refusal("none.nrrd", "NRRD0004\ntype: uchar\nencoding: raw\n\n", "no field 'dimension'");
  expect_refusal("cut.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n",
                 "does not end");
  expect_refusal("order.nrrd", "NRRD0004\ntype: short\ndimension: 3\nsizes: 1 1 1\nencoding: raw\n\nab",
                 "endian");
  expect_refusal("code.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1 1\nencoding: zstd\n\na",
                 "'zstd'");
  expect_refusal("sizes.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1 1.5 1\nencoding: raw\n\na",
                 "'1.5'");
}

}  // namespace
}  // namespace cbc3d::formats
