#include "mesher/core/label_array.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

ImageFrame frame_of_size(int x, int y, int z) {
  ImageFrame frame;
  frame.size = {x, y, z};
  return frame;
}

template <typename T>
class LabelArrayOf : public ::testing::Test {};
using Integers = ::testing::Types<std::int8_t, std::uint8_t, std::int16_t, std::uint16_t, std::int32_t,
                                  std::uint32_t, std::int64_t, std::uint64_t>;
TYPED_TEST_SUITE(LabelArrayOf, Integers);

TYPED_TEST(LabelArrayOf, EveryVoxelKeepsItsValue) {
  std::mt19937 random(7);
  constexpr std::array<int, 5> kValues = {0, 3, 17, 100, 127};
  std::vector<TypeParam> values(4 * 5 * 6);
  for (TypeParam& value : values) {
    value = static_cast<TypeParam>(kValues[random() % kValues.size()]);
  }
  const LabelImage image = to_label_image(values, frame_of_size(4, 5, 6));
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 3, 17, 100, 127}));
  for (std::size_t v = 0; v < values.size(); ++v) {
    EXPECT_EQ(image.labels[image.voxels[v]], static_cast<Label>(values[v])) << v;
  }
}

TEST(LabelArray, NegativeAndLargeLabelsAreKept) {
  const std::vector<std::int64_t> values = {-5, 0, std::numeric_limits<Label>::max(), -5};
  EXPECT_EQ(to_label_image(values, frame_of_size(2, 2, 1)).labels,
            (std::vector<Label>{0, -5, std::numeric_limits<Label>::max()}));
}

TEST(LabelArray, TheDirectionBecomesOrthonormal) {
  ImageFrame frame = frame_of_size(1, 1, 1);
  frame.direction(0, 1) = 1e-5;
  const LabelImage image = to_label_image(std::vector<std::uint8_t>{1}, frame);
  const Mat3 product = image.frame.direction.transposed() * image.frame.direction;
  EXPECT_NEAR(product(0, 1), 0, 1e-15);
}

/// The parameter that the refusal names.
template <typename T>
std::string refused(const std::vector<T>& values, const ImageFrame& frame) {
  try {
    to_label_image(values, frame);
  } catch (const InputError& error) {
    return error.parameter() + "|" + error.what();
  }
  return "not refused";
}

TEST(LabelArray, RefusesWhatIsNoLabelImage) {
  const std::vector<std::uint8_t> one = {1};
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  says(refused(one, frame_of_size(1, 1, 2)),
       "size|the label array: it has 1 values, but its size is 1 x 1 x 2");
  says(refused(one, frame_of_size(1, -1, -1)), "size|");
  says(refused(std::vector<std::uint8_t>{}, frame_of_size(0, 0, 0)), "size|");
  says(refused(std::vector<std::uint8_t>{0}, frame_of_size(1, 1, 1)), "labels|");
  says(refused(std::vector<std::int64_t>{std::int64_t{1} << 40}, frame_of_size(1, 1, 1)),
       "does not fit 32 bits");
  says(refused(std::vector<std::uint64_t>{std::uint64_t{1} << 32}, frame_of_size(1, 1, 1)),
       "does not fit 32 bits");
  std::vector<std::int32_t> grey(70000);
  for (std::size_t v = 0; v < grey.size(); ++v) {
    grey[v] = static_cast<std::int32_t>(v);
  }
  says(refused(grey, frame_of_size(70000, 1, 1)), "more than 65536 different values");
}

TEST(LabelArray, RefusesFramesThatAreNotOrthogonal) {
  const std::vector<std::uint8_t> one = {1};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double spacing_mm : {0.0, -1.0, nan}) {
    ImageFrame frame = frame_of_size(1, 1, 1);
    frame.spacing_mm.y = spacing_mm;
    EXPECT_EQ(refused(one, frame).substr(0, 11), "spacing_mm|");
  }
  for (const double entry : {0.1, nan}) {
    ImageFrame frame = frame_of_size(1, 1, 1);
    frame.direction(0, 1) = entry;
    EXPECT_EQ(refused(one, frame).substr(0, 10), "direction|");
  }
}

}  // namespace
}  // namespace cbc3d
