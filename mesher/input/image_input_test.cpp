// The image of a command with names from every source.
#include "mesher/input/image_input.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

class ImageInputTest : public ::testing::Test {
 protected:
  ImageInputTest() { write_label_image(testing::ball_image(12, 1, 4, 2), at("ball.nii.gz")); }
  [[nodiscard]] std::string at(const std::string& name) const { return folder_.file(name).string(); }
  testing::TemporaryFolder folder_{"input"};
};

TEST_F(ImageInputTest, NamesComeFromTheTableBeside) {
  folder_.write("ball.tsv", "index\tname\n1\tshell\n2\tcore\n3\tabsent\n");
  ImageInput input;
  static_cast<void>(read_input_image(at("ball.nii.gz"), input));
  EXPECT_EQ(input.names.text(1), "shell (1)");
  EXPECT_EQ(input.names.entries().size(), 2U) << "of the image's labels alone";
  EXPECT_TRUE(input.warnings.empty());
}

TEST_F(ImageInputTest, ABadTableBesideIsAWarningAndANamedOneAnError) {
  folder_.write("ball.txt", "measured on a Monday\n");
  ImageInput input;
  static_cast<void>(read_input_image(at("ball.nii.gz"), input));
  ASSERT_EQ(input.warnings.size(), 1U);
  EXPECT_NE(input.warnings[0].find("ball.txt': line 1 'measured on a Monday' has no whole number"),
            std::string::npos);
  ImageInput named{.names_file = at("ball.txt")};
  EXPECT_THROW(read_input_image(at("ball.nii.gz"), named), InputError);
}

TEST_F(ImageInputTest, ATableOfOtherLabelsIsSaid) {
  folder_.write("other.txt", "9 heart\n");
  ImageInput input{.names_file = at("other.txt")};
  static_cast<void>(read_input_image(at("ball.nii.gz"), input));
  ASSERT_EQ(input.warnings.size(), 1U);
  EXPECT_NE(input.warnings[0].find("names none of the labels"), std::string::npos);
  EXPECT_NE(input.warnings[0].find("which are 1, 2"), std::string::npos);
}

TEST_F(ImageInputTest, ChoicesAndNamesGoTogether) {
  folder_.write("names.csv", "1,shell\n2,core\n");
  ImageInput input{.names_file = at("names.csv"), .choice = {.labels = {2}, .keep_rest = true}};
  const LabelImage image = read_input_image(at("ball.nii.gz"), input);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 2, 3}));
  EXPECT_EQ(input.names.text(3), "rest (3)");
  EXPECT_EQ(input.names.find(1), nullptr);
}

}  // namespace
}  // namespace cbc3d
