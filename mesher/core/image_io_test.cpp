// Images: what is written is read back in place, what is bad is refused in one line.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/testing_files.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

class ImageIo : public testing::Files {};

LabelImage sample(const std::vector<Label>& labels) {
  LabelImage image = testing::noise_image(9, 0.5, 3);
  image.labels = labels;
  return image;
}

TEST_F(ImageIo, ImagesKeepLabelsAndFrame) {
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    for (const bool flipped : {false, true}) {
      LabelImage image = sample({0, 7, 300});
      image.frame.spacing_mm = {0.5, 0.75, 2};
      image.frame = testing::oblique(image.frame, flipped);
      write_label_image(image, file(name));
      const LabelImage back = read_label_image(file(name));
      EXPECT_EQ(back.labels, image.labels) << name;
      EXPECT_EQ(back.voxels, image.voxels) << name;
      for (const Index3& at : {Index3{0, 0, 0}, Index3{8, 0, 3}, Index3{2, 7, 8}}) {
        const Vec3 wanted = image.frame.to_physical(image.frame.local_centre(at[0], at[1], at[2]));
        const Vec3 got = back.frame.to_physical(back.frame.local_centre(at[0], at[1], at[2]));
        EXPECT_LT((wanted - got).norm(), 1e-4) << name << " flipped " << flipped;  // NIfTI stores floats
      }
    }
  }
}

TEST_F(ImageIo, NegativeAndLargeLabelsSurvive) {
  write_label_image(sample({0, -5, 70000}), file("n.nrrd"));
  EXPECT_EQ(read_label_image(file("n.nrrd")).labels, (std::vector<Label>{0, -5, 70000}));
}

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\nendian: little\nencoding: raw\n" + fields + "\n" + data;
}

TEST_F(ImageIo, BadImagesAreRefusedWithOneLine) {
  EXPECT_NE(why_not_read("absent.nii").find("does not exist"), std::string::npos);
  write("text.nii", "hello");
  EXPECT_NE(why_not_read("text.nii"), "");
  write("flat.nrrd", nrrd("type: uchar\ndimension: 2\nsizes: 2 2\n", "abcd"));
  EXPECT_NE(why_not_read("flat.nrrd").find("2-dimensional"), std::string::npos);
  write("colour.nrrd",
        nrrd("type: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain\n",
             std::string(24, 'a')));
  EXPECT_NE(why_not_read("colour.nrrd").find("3 components"), std::string::npos);
  write("empty.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 2 2 2\n", std::string(8, '\0')));
  EXPECT_NE(why_not_read("empty.nrrd").find("background"), std::string::npos);
  const float half[8] = {0, 1, 2, 0.5F, 0, 0, 1, 1};
  write("half.nrrd", nrrd("type: float\ndimension: 3\nsizes: 2 2 2\n",
                          std::string(reinterpret_cast<const char*>(half), sizeof(half))));
  EXPECT_NE(why_not_read("half.nrrd").find("0.5"), std::string::npos);
  write("short.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 20 20 20\n", "abc"));
  EXPECT_NE(why_not_read("short.nrrd"), "");
}

TEST_F(ImageIo, FloatImagesWithWholeLabelsAreRead) {
  const float whole[8] = {0, 1, 2, 2, 0, 0, 1, 1};
  write("whole.nrrd", nrrd("type: float\ndimension: 3\nsizes: 2 2 2\n",
                           std::string(reinterpret_cast<const char*>(whole), sizeof(whole))));
  EXPECT_EQ(read_label_image(file("whole.nrrd")).labels, (std::vector<Label>{0, 1, 2}));
}

TEST_F(ImageIo, FourthDimensionOfOneIsNoDimension) {
  write("four.nrrd", nrrd("type: uchar\ndimension: 4\nsizes: 2 2 2 1\n", std::string("\0\1\2\0\1\2\0\1", 8)));
  EXPECT_EQ(read_label_image(file("four.nrrd")).frame.size, (Index3{2, 2, 2}));
  write("five.nrrd", nrrd("type: uchar\ndimension: 4\nsizes: 2 2 1 2\n", std::string("\0\1\2\0\1\2\0\1", 8)));
  EXPECT_NE(why_not_read("five.nrrd").find("2 volumes"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d
