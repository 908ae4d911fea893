#include "baselines/cleaver/adapter.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines {
namespace {

TEST(CleaverAdapter, IsARepeatableProgramOfItsOwnUnderThisProjectsLicence) {
  const std::vector<Adapter> adapters = cleaver_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  EXPECT_EQ(adapters[0].licence, "Apache-2.0");
  EXPECT_TRUE(adapters[0].deterministic);
  EXPECT_TRUE(adapters[0].multithreaded);
  const auto argv = adapters[0].command("bin", {"in.nii", "out.vtu", "r.json", 3, {{"lipschitz", "0.4"}}});
  EXPECT_EQ(argv.front(), "bin/cbc3d-mesher-cleaver");
  EXPECT_EQ(argv.back(), "0.4");
}

TEST(CleaverAdapter, MoreSamplesAreMoreElements) {
  const auto dial = size_dial_of(cleaver_adapter(), {});
  ASSERT_TRUE(dial);
  EXPECT_EQ(dial->parameter, "sampling-rate");
  EXPECT_GT(dial->exponent, 0);
}

}  // namespace
}  // namespace cbc3d::baselines
