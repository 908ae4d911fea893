#include "baselines/core/size_dial.hpp"

#include <gtest/gtest.h>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines {
namespace {

using Parameters = std::map<std::string, std::string>;

const ParameterSpecs kSpecs{{"cell-size", "2.5", "mm", ""},
                            {"facet-size", "2", "mm", ""},
                            {"finest", "the voxels' spacing", "mm", ""}};

TEST(SizeDial, FollowersKeepTheRatioOfTheJob) {
  const SizeDial dial{.parameter = "cell-size", .followers = {{"facet-size", 7}}};
  EXPECT_EQ(with_size(dial, 5, kSpecs, {}), (Parameters{{"cell-size", "5"}, {"facet-size", "4"}}));
  const Parameters given{{"cell-size", "3"}, {"facet-size", "1"}, {"perturb", "false"}};
  EXPECT_EQ(with_size(dial, 6, kSpecs, given),
            (Parameters{{"cell-size", "6"}, {"facet-size", "2"}, {"perturb", "false"}}));
  EXPECT_EQ(with_size(dial, 1, kSpecs, {{"facet-size", "5"}}).at("facet-size"), "2");
}

TEST(SizeDial, AFollowerOfADefaultInWordsHasTheUsualRatio) {
  const SizeDial dial{.parameter = "finest", .followers = {{"cell-size", 8}}};
  EXPECT_EQ(with_size(dial, 0.5, kSpecs, {{"cell-size", "3"}}),
            (Parameters{{"cell-size", "4"}, {"finest", "0.5"}}));
}

TEST(SizeDial, FixedParametersGoBeforeThoseOfTheJob) {
  const SizeDial dial{.parameter = "cell-size", .fixed = {{"facet-size", "9"}}};
  EXPECT_EQ(with_size(dial, 2, kSpecs, {{"facet-size", "1"}}),
            (Parameters{{"cell-size", "2"}, {"facet-size", "9"}}));
}

TEST(SizeDial, WritesFiveDigitsOrWholeElements) {
  EXPECT_EQ(dial_text({.parameter = "size"}, 1.23456789), "1.2346");
  EXPECT_EQ(dial_text({.parameter = "elements", .counts_elements = true}, 123456.7), "123457");
}

}  // namespace
}  // namespace cbc3d::baselines
