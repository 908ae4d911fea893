#include "mesher/formats/read_header.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class ReadHeader : public testing::Headers {};
using testing::nrrd;
using testing::packed;

TEST_F(ReadHeader, NamesWhatItDoesNotRead) {
  const struct {
    std::string bytes;
    const char* words;
  } files[] = {{"", "empty"},
               {"hello", "fewer than any header"},
               {std::string(500, 'x'), "not an image format that is known"},
               {"\x89PNG\r\n\x1a\n" + std::string(100, '\0'), "PNG"},
               {"\xFF\xD8\xFF\xE0" + std::string(100, '\0'), "JPEG"},
               {"II*" + std::string(100, '\0'), "TIFF"},
               {"\x89HDF\r\n\x1a\n" + std::string(100, '\0'), "HDF5"},
               {"# vtk DataFile Version 3.0\n" + std::string(100, '\0'), "VTK"},
               {std::string(128, '\0') + "DICM" + std::string(100, '\0'), "DICOM"},
               {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "Git LFS"},
               {packed(nrrd("")), "compressed as a whole"},
               {packed("nothing that is known, but long enough to be a header of something or other"),
                "not an image"}};
  for (const auto& [bytes, words] : files) {
    expect_refusal("file.nii", bytes, words);
  }
}

TEST_F(ReadHeader, AFileThatMayNotBeReadIsNoUnknownFormat) {
  try {
    static_cast<void>(read_image_header(folder_.file("absent.nii")));
    FAIL();
  } catch (const FormatError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be opened"), std::string::npos);
  }
}

}  // namespace
}  // namespace cbc3d::formats
