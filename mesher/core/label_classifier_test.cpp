#include "mesher/core/label_classifier.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

namespace cbc3d {
namespace {

template <typename T>
LabelImage classified(const std::vector<T>& values) {
  LabelImage image;
  Classifier<T> classifier(values.data(), values.size(), "'a.nrrd'");
  classifier.find_labels(image);
  image.voxels = classifier.voxels();
  return image;
}

template <typename T>
std::string refusal_of(const std::vector<T>& values) {
  try {
    classified(values);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Classifier, LabelsAscendBehindBackgroundAndVoxelsNameThem) {
  const std::vector<std::int16_t> values = {7, 0, -3, 7, 300, 0};
  const LabelImage image = classified(values);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, -3, 7, 300}));
  for (std::size_t v = 0; v < values.size(); ++v) {
    EXPECT_EQ(image.labels[image.voxels[v]], values[v]);
  }
}

TEST(Classifier, BytesThatAreMaterialsMayStayAsTheyAre) {
  const auto are_materials = [](const std::vector<std::uint8_t>& values) {
    LabelImage image;
    Classifier<std::uint8_t> classifier(values.data(), values.size(), "");
    classifier.find_labels(image);
    return classifier.values_are_materials();
  };
  EXPECT_TRUE(are_materials({0, 1, 2, 1, 0}));
  EXPECT_FALSE(are_materials({0, 1, 3}));  // label 3 is material 2
}

TEST(Classifier, EveryByteFoundInLongArraysToo) {
  std::vector<std::uint8_t> values(3U << 20U, 5);
  values[(1U << 20U) + 17] = 9;  // one voxel in the second piece
  EXPECT_EQ(classified(values).labels, (std::vector<Label>{0, 5, 9}));
}

TEST(Classifier, RefusalsNameTheSubjectAndTheValue) {
  EXPECT_EQ(refusal_of<float>({0, 1.5F}),
            "'a.nrrd': it has the fractional value 1.5; give integer labels (threshold or round it first)");
  EXPECT_NE(refusal_of<std::int64_t>({0, std::int64_t{1} << 40U}).find("1099511627776 does not fit 32 bits"),
            std::string::npos);
  std::vector<std::int32_t> grey(70000);
  std::iota(grey.begin(), grey.end(), 0);
  EXPECT_NE(refusal_of(grey).find("more than 65536 different values"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d
