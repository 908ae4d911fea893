#include "mesher/formats/metaimage.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class MetaImage : public testing::Headers {};
using testing::metaimage;
using testing::packed;

const std::string kVoxels = metaimage("").substr(metaimage("").size() - 24);

TEST_F(MetaImage, FrameByItsSeveralNames) {
  for (const char* matrix : {"TransformMatrix", "Orientation", "Rotation"}) {
    for (const char* offset : {"Offset", "Origin", "Position"}) {
      const ImageHeader header =
          header_of("a.mha", metaimage(std::string(matrix) + " = 0 1 0 -1 0 0 0 0 1\n" + offset +
                                       " = 1 2 3\nElementSpacing = 0.5 1 2\n"));
      EXPECT_EQ(header.axes[0], (Triple{0, 1, 0}));
      EXPECT_EQ(header.axes[1], (Triple{-1, 0, 0}));
      EXPECT_EQ(header.origin_mm, (Triple{1, 2, 3}));
      EXPECT_EQ(header.spacing_mm, (Triple{0.5, 1, 2}));
    }
  }
  EXPECT_EQ(header_of("b.mha", metaimage("ElementSize = 3 3 3\n")).spacing_mm, (Triple{3, 3, 3}));
  EXPECT_EQ(header_of("c.mha", metaimage("ElementSpacing = 3 3 3\nDistanceUnits = um\n")).spacing_mm,
            (Triple{0.003, 0.003, 0.003}));
}

TEST_F(MetaImage, LettersStandInForAMatrixAndAreCheckedAgainstOne) {
  const std::string spacing = "ElementSpacing = 1 1 1\n";
  const ImageHeader header = header_of("a.mha", metaimage(spacing + "AnatomicalOrientation = LPI\n"));
  EXPECT_EQ(header.axes[0], (Triple{-1, 0, 0}));
  EXPECT_EQ(header.axes[1], (Triple{0, -1, 0}));
  const std::string identity = spacing + "TransformMatrix = 1 0 0 0 1 0 0 0 1\nAnatomicalOrientation = ";
  EXPECT_TRUE(header_of("b.mha", metaimage(identity + "RAI\n")).warnings.empty());
  EXPECT_TRUE(header_of("c.mha", metaimage(identity + "???\n")).warnings.empty());
  EXPECT_EQ(header_of("d.mha", metaimage(identity + "LPI\n")).warnings.size(), 1U);
  expect_refusal("e.mha", metaimage(spacing + "AnatomicalOrientation = RRI\n"), "'RRI'");
}

TEST_F(MetaImage, VoxelsCompressedDetachedAndInLists) {
  const auto plain = voxels_of("a.mha", metaimage(""));
  const std::string head = "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\n";
  EXPECT_EQ(voxels_of("z.mha", head + "CompressedData = True\nElementDataFile = LOCAL\n" + packed(kVoxels)),
            plain);
  folder_.write("v.raw", "head" + kVoxels);
  EXPECT_EQ(voxels_of("d.mhd", head + "HeaderSize = 4\nElementDataFile = v.raw\n"), plain);
  EXPECT_EQ(voxels_of("e.mhd", head + "HeaderSize = -1\nElementDataFile = v.raw\n"), plain);
  folder_.write("s1.raw", kVoxels.substr(0, 12));
  folder_.write("s2.raw", kVoxels.substr(12));
  EXPECT_EQ(voxels_of("p.mhd", head + "ElementDataFile = s%d.raw 1 2 1\n"), plain);
  EXPECT_EQ(voxels_of("l.mhd", head + "ElementDataFile = LIST\ns1.raw\ns2.raw\n"), plain);
  expect_refusal("x.mhd", head + "HeaderSize = 4\nElementDataFile = s1.raw\n", "truncated");
}

TEST_F(MetaImage, DamageIsNamed) {
  expect_refusal("a.mhd",
                 "ObjectType = Image\nNDims = 3\nDimSize = 8 8 8\nElementType = MET_UCHAR\n"
                 "ElementDataFile = %s%s%n 1 8 1\n",
                 "'%s%s%n'");
  expect_refusal("b.mha", "ObjectType = Image\nNDims = -1\nElementDataFile = LOCAL\n", "NDims -1");
  expect_refusal("c.mha", "ObjectType = Image\nNDims = 2000000000\nElementDataFile = LOCAL\n", "NDims");
  expect_refusal("d.mha", metaimage("ElementSpacing = nan 1 1\n"), "'nan'");
  expect_refusal("e.mha", metaimage("ElementSpacing = 1 1\n"), "3 numbers");
  expect_refusal("f.mha", metaimage("TransformMatrix = 2 0 0 0 1 0 0 0 1\n"), "length 2");
  expect_refusal("g.mha", metaimage("TransformMatrix = 0 0 0 0 1 0 0 0 1\n"), "no direction");
  expect_refusal("h.mha", metaimage("ElementNumberOfChannels = 3\n"), "3 components");
  expect_refusal("i.mha", "ObjectType = Image\nNDims = 3\n", "ElementDataFile");
  expect_refusal("j.mha", "ObjectType = Tube\nNDims = 3\nElementDataFile = LOCAL\n", "'Tube'");
  expect_refusal("k.mha", metaimage("NDims = 3\n"), "twice");
}

}  // namespace
}  // namespace cbc3d::formats
