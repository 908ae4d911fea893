#include "mesher/formats/dicom_data_set.hpp"

#include <gtest/gtest.h>

#include "mesher/formats/testing_dicom.hpp"

namespace cbc3d::formats {
namespace {

using testing::DicomWriter;

std::string refusal_of(const std::string& bytes) {
  try {
    parse_dicom(bytes);
  } catch (const FormatError& error) {
    return error.what();
  }
  return "";
}

std::string sample(const DicomWriter& w) {
  return w.file(
      w.element(0x00080060, "CS", "SEG") + w.number(0x00280010, 7) +
      w.sequence(0x00289110, {w.element(0x00280030, "DS", "0.5\\0.25"), w.number(0x00280011, 300)}) +
      w.element(0x7FE00010, "OB", "ab"));
}

TEST(DicomDataSet, IsReadInEveryFormThatIsUncompressed) {
  for (const bool is_explicit : {true, false}) {
    for (const bool has_delimiters : {true, false}) {
      const std::string bytes = sample(DicomWriter(is_explicit, has_delimiters));
      ASSERT_TRUE(is_dicom(bytes));
      const DicomDataSet file = parse_dicom(bytes);
      EXPECT_EQ(file.text(0x00080060), "SEG");
      EXPECT_EQ(file.number(0x00280010, 0), 7);
      EXPECT_EQ(file.number(0x00280011, -1), -1);
      ASSERT_EQ(file.items(0x00289110).size(), 2U);
      EXPECT_EQ(file.items(0x00289110)[0].text(0x00280030), "0.5 0.25");
      EXPECT_EQ(file.items(0x00289110)[1].number(0x00280011, 0), 300);
      EXPECT_TRUE(file.items(0x00080060).empty());
      EXPECT_EQ(file.find(0x7FE00010)->value, "ab");
    }
  }
}

TEST(DicomDataSet, EveryCutIsRefusedOrBetweenElements) {
  for (const bool is_explicit : {true, false}) {
    const std::string whole = sample(DicomWriter(is_explicit, true));
    for (std::size_t bytes = 132; bytes < whole.size(); ++bytes) {
      const std::string words = refusal_of(whole.substr(0, bytes));
      EXPECT_TRUE(words.empty() || words.find("copy it again") != std::string::npos ||
                  words.find("transfer syntax") != std::string::npos)
          << words;
    }
  }
}

TEST(DicomDataSet, OtherTransferSyntaxesAreNamed) {
  const DicomWriter w;
  EXPECT_NE(refusal_of(w.file("", "1.2.840.10008.1.2.2")).find("big-endian"), std::string::npos);
  EXPECT_NE(refusal_of(w.file("", "1.2.840.10008.1.2.1.99")).find("deflated"), std::string::npos);
  EXPECT_NE(refusal_of(std::string(128, '\0') + "DICM").find("missing"), std::string::npos);
}

TEST(DicomDataSet, DeepSequencesAndFalseItemsAreRefused) {
  const DicomWriter w(true, true);
  std::string deep = w.number(0x00280010, 1);
  for (int depth = 0; depth < 2000; ++depth) {
    deep = w.sequence(0x00289110, {deep});
  }
  EXPECT_NE(refusal_of(w.file(deep)).find("deeper"), std::string::npos);
  std::string bad = w.sequence(0x00289110, {w.number(0x00280010, 1)});
  bad[12] = 'x';
  EXPECT_NE(refusal_of(w.file(bad)).find("something else than items"), std::string::npos);
}

TEST(DicomDataSet, FragmentsAreCompressedPixels) {
  const std::string open =
      DicomWriter::tag_bytes(0x7FE00010) + "OB" + std::string(2, '\0') + "\xFF\xFF\xFF\xFF";
  const std::string item = DicomWriter::tag_bytes(0xFFFEE000) + DicomWriter::little(2, 4) + "xy";
  const std::string end = DicomWriter::tag_bytes(0xFFFEE0DD) + DicomWriter::little(0, 4);
  const std::string bytes = DicomWriter().file(open + item + end);
  EXPECT_TRUE(parse_dicom(bytes).find(0x7FE00010)->is_compressed);
  EXPECT_NE(refusal_of(DicomWriter().file(open + item)).find("break off"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::formats
