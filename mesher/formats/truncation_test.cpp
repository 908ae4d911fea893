// Images of every format, cut short: one line, or the very image of the whole file.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "mesher/formats/dicom_segmentation.hpp"
#include "mesher/formats/testing_dicom.hpp"
#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

using testing::packed;

/// A committed image, of which the fuzzer begins too.
std::string image(const std::string& name) {
  std::ifstream in(std::string(CBC3D_IMAGES "/") + name, std::ios::binary);
  EXPECT_TRUE(in) << name;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Frame and meaning of the voxels as text that tells any two apart.
std::string text_of(const ImageHeader& header) {
  std::string text = header.format;
  const auto add = [&text](auto number) { text += " " + std::to_string(number); };
  const auto add_triple = [&](const Triple& triple) { add(triple[0]), add(triple[1]), add(triple[2]); };
  for (const std::size_t size : header.size) add(size);
  add(header.volumes), add(static_cast<int>(header.component)), add(header.slope), add(header.intercept);
  add_triple(header.spacing_mm), add_triple(header.origin_mm);
  for (const Triple& axis : header.axes) add_triple(axis);
  for (const Segment& segment : header.segments) text += segment.name + std::to_string(segment.value);
  return text;
}

class Truncation : public testing::Headers {
 protected:
  struct Image {
    std::string text;  ///< header and voxels; empty where the file is refused
    bool warned = false;
  };

  [[nodiscard]] Image image_in(const std::string& name) const {
    try {
      ImageHeader header = read_image_header(folder_.file(name));
      require_plausible_length(header);
      std::vector<std::uint8_t> buffer(lead_bytes(header) + voxel_bytes(header));
      read_voxels(header, buffer);
      const auto voxels = buffer.begin() + static_cast<std::ptrdiff_t>(lead_bytes(header));
      return {text_of(header) + std::string(voxels, buffer.end()), !header.warnings.empty()};
    } catch (const FormatError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return {};
    }
  }

  /// Cuts the file `cut` everywhere while the image is read by `name`.
  void expect_cuts_refused(const std::string& name, const std::string& cut) const {
    const std::string whole = folder_.content(cut);
    const Image expected = image_in(name);
    ASSERT_NE(expected.text, "") << name;
    for (std::size_t length = 0; length < whole.size(); ++length) {
      folder_.write(cut, whole.substr(0, length));
      const Image found = image_in(name);
      EXPECT_TRUE(found.text.empty() || found.text == expected.text || found.warned)
          << cut << " cut at byte " << length << " of " << whole.size() << " is taken as another image";
    }
    folder_.write(cut, whole);
  }
  void expect_cuts_of_bytes_refused(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
    expect_cuts_refused(name, name);
  }
};

TEST_F(Truncation, FilesOfOnePiece) {
  for (const char* const name : {"a.gipl", "a.inr", "a.mgh", "a.mha", "a.mif", "a.nrrd", "gz.nrrd",
                                 "nifti1.nii", "nifti1.nii.gz", "nifti2.nii", "text.nrrd"}) {
    expect_cuts_of_bytes_refused(name, image(name));
  }
}

TEST_F(Truncation, FilesThatAreCompressedAsAWhole) {
  for (const char* const name : {"a.gipl", "a.inr", "a.mgh", "a.mif", "nifti2.nii"}) {
    const std::string packed_name = name == std::string("a.mgh") ? "a.mgz" : std::string(name) + ".gz";
    expect_cuts_of_bytes_refused(packed_name, packed(image(name)));
  }
}

TEST_F(Truncation, ValuesInText) {
  const std::string head = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 1\nendian: big\nencoding: ";
  expect_cuts_of_bytes_refused("text.nrrd", head + "ascii\n\n1 -2\n300 412\n");
  expect_cuts_of_bytes_refused("hex.nrrd", head + "hex\n\n0001 fffe\n012C 0004\n");
}

/// Both files of each pair. NRRD's header has its file of voxels in its last line, as Teem writes it.
TEST_F(Truncation, HeadersBesideTheirVoxels) {
  const std::string nifti = testing::nifti(), voxels = nifti.substr(nifti.size() - 24);
  const std::string frame = "dimension: 3\nsizes: 2 3 4\nspacings: 1 2 3\nencoding: ";
  const auto expect_pair = [&](const std::string& header, const std::string& bytes, const std::string& data,
                               const std::string& data_bytes) {
    folder_.write(header, bytes);
    folder_.write(data, data_bytes);
    expect_cuts_refused(header, header);
    expect_cuts_refused(header, data);
  };
  std::string pair = nifti.substr(0, 348);
  pair.replace(344, 4, std::string("ni1\0", 4));
  testing::put(pair, 108, 0.0F);
  expect_pair("n.hdr", pair, "n.img", voxels);
  pair.replace(344, 4, std::string(4, '\0'));
  expect_pair("analyze.hdr", pair, "analyze.img", voxels);
  expect_pair("n.nhdr", "NRRD0004\ntype: uchar\n" + frame + "raw\ndata file: n.raw\n", "n.raw", voxels);
  expect_pair("z.nhdr", "NRRD0004\ntype: uchar\n" + frame + "gzip\ndata file: z.gz\n", "z.gz",
              packed(voxels));
  expect_pair("m.mhd",
              "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\nElementSpacing = 1 2 "
              "3\nElementDataFile = m.raw\n",
              "m.raw", voxels);
  expect_pair("m.mih",
              "mrtrix image\ndim: 2,3,4\nvox: 1,1,1\nlayout: +0,+1,+2\ndatatype: UInt8\nfile: m.dat\nEND\n",
              "m.dat", voxels);
}

TEST_F(Truncation, DicomSegmentations) {
  const auto text_in = [&](const std::string& bytes) -> std::string {
    folder_.write("a.dcm", bytes);
    try {
      const DicomSegmentation seg = read_dicom_segmentation(folder_.file("a.dcm"));
      return text_of(seg.header) + std::string(seg.labels.begin(), seg.labels.end());
    } catch (const FormatError&) {
      return "";
    }
  };
  for (const bool is_explicit : {true, false}) {
    const std::string whole = testing::segmentation().bytes(testing::DicomWriter(is_explicit, !is_explicit));
    const std::string expected = text_in(whole);
    ASSERT_NE(expected, "");
    for (std::size_t length = 0; length < whole.size(); ++length) {
      const std::string found = text_in(whole.substr(0, length));
      EXPECT_TRUE(found.empty() || found == expected) << "cut at byte " << length << " of " << whole.size();
    }
  }
}

}  // namespace
}  // namespace cbc3d::formats
