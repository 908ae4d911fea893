// The notes of .seg.nrrd files: those of 3D Slicer 5, of versions before 4.11, and damaged ones.
#include "mesher/formats/nrrd_segments.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

TEST(NrrdSegments, HaveNameValueLayerAndColour) {
  const auto segments = nrrd_segments({{"Segment0_Name", "right lung"},
                                       {"Segment0_LabelValue", "5"},
                                       {"Segment0_Layer", "1"},
                                       {"Segment0_Color", "1 0.5 0"},
                                       {"Segment10_Name", "a\\nb \\\\c"},
                                       {"Segment10_LabelValue", "-7"},
                                       {"Segment2_Name", "heart"},
                                       {"Segmentation_MasterRepresentation", "Binary labelmap"}},
                                      2);
  ASSERT_EQ(segments.size(), 3U);
  EXPECT_EQ(segments[0].name, "right lung");
  EXPECT_EQ(segments[0].value, 5);
  EXPECT_EQ(segments[0].layer, 1U);
  EXPECT_EQ(segments[0].colour, (std::array<std::uint8_t, 3>{255, 128, 0}));
  EXPECT_EQ(segments[1].name, "heart") << "segments are in the order of their numbers, not of the text";
  EXPECT_EQ(segments[2].name, "a b \\c");
  EXPECT_EQ(segments[2].value, -7);
  EXPECT_FALSE(segments[2].colour);
}

TEST(NrrdSegments, BeforeSlicer411EachIsALayer) {
  const NrrdFields notes = {{"Segment0_Name", "a"}, {"Segment1_Name", "b"}};
  const auto segments = nrrd_segments(notes, 2);
  EXPECT_EQ(segments[1].layer, 1U);
  EXPECT_EQ(segments[1].value, 1);
  EXPECT_EQ(nrrd_segments(notes, 1)[1].layer, 0U);
  EXPECT_TRUE(nrrd_segments({}, 1).empty());
}

TEST(NrrdSegments, DamageIsNamed) {
  EXPECT_THROW(nrrd_segments({{"Segment0_LabelValue", "one"}}, 1), FormatError);
  EXPECT_THROW(nrrd_segments({{"Segment0_Layer", "1"}}, 1), FormatError);
  EXPECT_FALSE(nrrd_segments({{"Segment0_Color", "red"}}, 1)[0].colour);
}

using NrrdSegmentsFile = testing::Headers;

TEST_F(NrrdSegmentsFile, AreReadWithTheHeader) {
  const ImageHeader header =
      header_of("a.seg.nrrd", testing::nrrd("Segment0_Name:=liver\nSegment0_LabelValue:=3\n"));
  ASSERT_EQ(header.segments.size(), 1U);
  EXPECT_EQ(header.segments[0].name, "liver");
  EXPECT_TRUE(header.warnings.size() == 1 || header.warnings.size() == 2) << "of the frame alone";
}

}  // namespace
}  // namespace cbc3d::formats
