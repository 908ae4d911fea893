// Values and frames of images of several formats, as labels and as grey values.
#include "mesher/core/read_image.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "mesher/core/testing_files.hpp"

namespace cbc3d {
namespace {

class ReadImage : public testing::Files {};

template <typename T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A NIfTI file of 2 x 2 x 2 floats.
std::string nifti(const std::vector<float>& values, float slope, float intercept) {
  std::string bytes(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); };
  put(0, std::int32_t{348});
  for (std::size_t i = 0; i < 4; ++i) {
    put(40 + 2 * i, static_cast<std::int16_t>(i == 0 ? 3 : 2));
    put(76 + 4 * i, 1.0F);
    if (i < 3) put(280 + 20 * i, 1.0F);
  }
  put(70, std::int16_t{16});
  put(72, std::int16_t{32});
  put(108, 352.0F);
  put(112, slope);
  put(116, intercept);
  put(254, std::int16_t{1});
  bytes.replace(344, 4, std::string("n+1\0", 4));
  return bytes + bytes_of(values);
}

TEST_F(ReadImage, ScaledValuesAndThoseThatAreNoNumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  write("a.nii", nifti({0, 1, 2, 3, nan, HUGE_VALF, 1, 0}, 1, 0));
  std::vector<std::string> warnings;
  const LabelImage image = read_label_image(file("a.nii"), {}, &warnings);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 1, 2, 3}));
  EXPECT_EQ(image.voxels[4], 0);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("2 voxels are no finite number"), std::string::npos);
  write("b.nii", nifti({0, 1, 2, 3, 0, 0, 1, 0}, 2, 1));
  EXPECT_EQ(read_label_image(file("b.nii")).labels, (std::vector<Label>{0, 1, 3, 5, 7}));
  write("c.nii", nifti({0, 1, 2, 3, 0, 0, 1, 0}, 0, 5));
  EXPECT_EQ(read_label_image(file("c.nii")).labels, (std::vector<Label>{0, 1, 2, 3}));
}

TEST_F(ReadImage, RoundingIsAskedForAndBounded) {
  write("a.nii", nifti({0, 1.0000001F, 1.99999F, 3, 0, 0, 1, 0}, 1, 0));
  EXPECT_NE(why_not_read("a.nii").find("1.0000001"), std::string::npos);
  EXPECT_NE(why_not_read("a.nii").find("round_values"), std::string::npos);
  EXPECT_EQ(read_label_image(file("a.nii"), {.round_values = true}).labels, (std::vector<Label>{0, 1, 2, 3}));
  write("b.nii", nifti({0, 1.001F, 2, 3, 0, 0, 1, 0}, 1, 0));
  EXPECT_THROW(read_label_image(file("b.nii"), {.round_values = true}), InputError);
}

TEST_F(ReadImage, AShearIsTakenWhenItIsAccepted) {
  const std::string head =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nspace: LPS\n"
      "space origin: (0,0,0)\nspace directions: ";
  const std::string voxels = std::string("\n\n") + std::string("\0\1\2\3\4\0\1\2", 8);
  write("s.nrrd", head + "(1,0,0) (0.02,1,0) (0,0,1)" + voxels);
  EXPECT_NE(why_not_read("s.nrrd").find("sheared by 0.02"), std::string::npos) << why_not_read("s.nrrd");
  const LabelImage image = read_label_image(file("s.nrrd"), {.accept_shear = true});
  EXPECT_NEAR(image.frame.direction.column(0).dot(image.frame.direction.column(1)), 0, 1e-15);
  write("t.nrrd", head + "(1,0,0) (0.0002,1,0) (0,0,1)" + voxels);
  EXPECT_EQ(why_not_read("t.nrrd"), "");
}

TEST_F(ReadImage, GreyValuesKeepTheirFraction) {
  write("a.nii", nifti({0, 1.5F, 2, 3, 0, 0, 1, 0}, 2, 1));
  const GreyImage grey = read_grey_image(file("a.nii"));
  EXPECT_EQ(grey.values, (std::vector<float>{1, 4, 5, 7, 1, 1, 3, 1}));
  EXPECT_EQ(grey.frame.size, (Index3{2, 2, 2}));
  EXPECT_EQ(format_of_image(file("a.nii")), "NIfTI-1");
  EXPECT_THROW(read_grey_image(file("absent.nii")), InputError);
}

TEST_F(ReadImage, WideIntegersFitOrAreRefused) {
  const std::string head =
      "NRRD0004\ntype: int64\ndimension: 3\nsizes: 2 1 1\nencoding: raw\nendian: little\n\n";
  write("a.nrrd", head + bytes_of(std::vector<std::int64_t>{0, -70000}));
  EXPECT_EQ(read_label_image(file("a.nrrd")).labels, (std::vector<Label>{0, -70000}));
  write("b.nrrd", head + bytes_of(std::vector<std::int64_t>{0, std::int64_t{1} << 40U}));
  EXPECT_NE(why_not_read("b.nrrd").find("1099511627776 does not fit"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d
