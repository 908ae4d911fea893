// Choices of labels and background on an image whose labels are known.
#include "mesher/preprocess/choose_labels.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesher/testing/error_of.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

class ChooseLabels : public ::testing::Test {
 protected:
  /// Along x: 0, 2, 5, 7.
  [[nodiscard]] static LabelImage image() {
    LabelImage image =
        testing::make_image({4, 1, 1}, {1, 1, 1}, 3, [](const Vec3& p) { return static_cast<int>(p.x); });
    image.labels = {0, 2, 5, 7};
    return image;
  }
  [[nodiscard]] std::vector<Label> chosen(const LabelChoice& choice) {
    LabelImage changed = image();
    warnings_.clear();
    choose_labels(changed, names_, choice, "'a.nrrd'", warnings_);
    std::vector<Label> labels;
    labels.reserve(4);
    for (std::size_t v = 0; v < 4; ++v) {
      labels.push_back(changed.labels[changed.voxels[v]]);
    }
    for (std::size_t m = 1; m < changed.labels.size(); ++m) {
      EXPECT_LT(changed.labels[m - 1] == 0 ? std::numeric_limits<Label>::min() : changed.labels[m - 1],
                changed.labels[m]);
    }
    return labels;
  }
  void expect_refusal(const LabelChoice& choice, const std::string& words) {
    const std::string error = testing::error_of([&] { static_cast<void>(chosen(choice)); });
    EXPECT_NE(error.find(words), std::string::npos) << error;
  }
  LabelNames names_;
  std::vector<std::string> warnings_;
};

using Labels = std::vector<Label>;

TEST_F(ChooseLabels, TheRestBecomesBackground) {
  EXPECT_EQ(chosen({}), (Labels{0, 2, 5, 7}));
  EXPECT_EQ(chosen({.labels = {7, 2}}), (Labels{0, 2, 0, 7}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ChooseLabels, TheRestIsALabelOfItsOwn) {
  EXPECT_EQ(chosen({.labels = {5}, .keep_rest = true}), (Labels{0, 8, 5, 8}));
  EXPECT_EQ(names_.text(8), "rest (8)");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("together label 8"), std::string::npos);
  EXPECT_EQ(chosen({.labels = {2, 5, 7}, .keep_rest = true}), (Labels{0, 2, 5, 7}));
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(ChooseLabels, AnotherValueIsBackground) {
  EXPECT_EQ(chosen({.background = {0, 5}}), (Labels{0, 2, 0, 7}));
  EXPECT_TRUE(warnings_.empty());
  names_.set({.label = 0, .name = "air", .colour = {}});
  names_.set({.label = 5, .name = "outside", .colour = {}});
  EXPECT_EQ(chosen({.background = {5}}), (Labels{5, 2, 0, 7})) << "0 takes the number";
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("value 0 have the label 5"), std::string::npos);
  EXPECT_EQ(names_.text(5), "air (5)");
  EXPECT_EQ(chosen({.background = {5}, .labels = {5, 2}}), (Labels{5, 2, 0, 0}));
}

TEST_F(ChooseLabels, WhatTheImageLacksIsRefusedWithWhatItHas) {
  expect_refusal({.labels = {2, 9, 11}}, "'a.nrrd' has no label 9, 11, which --labels names; it has 2, 5, 7");
  expect_refusal({.background = {3}}, "no label 3, which --background names");
  expect_refusal({.background = {0, 2}, .labels = {2}}, "no label 2");
  expect_refusal({.labels = {0, 2}}, "names 0, which is the background");
  expect_refusal({.keep_rest = true}, "--keep-rest without --labels");
  expect_refusal({.background = {0, 2, 5, 7}}, "nothing but background");
}

TEST_F(ChooseLabels, ManyLabelsAreCutShort) {
  Labels many(25, 3);
  EXPECT_EQ(labels_text({1, -2}), "1, -2");
  EXPECT_TRUE(labels_text(many).ends_with("3 and 5 others"));
}

}  // namespace
}  // namespace cbc3d
