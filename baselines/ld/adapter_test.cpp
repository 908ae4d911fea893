#include "baselines/ld/adapter.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines {
namespace {

TEST(LdAdapter, IsARepeatableProgramOfOurOwnWithThePapersParameters) {
  const std::vector<Adapter> adapters = ld_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  EXPECT_EQ(adapters[0].licence, "Apache-2.0");
  EXPECT_TRUE(adapters[0].deterministic);
  const auto argv = adapters[0].command("bin", {"in.nii", "out.vtu", "r.json", 3, {{"mesh-to-image", "4"}}});
  EXPECT_EQ(argv.front(), "bin/cbc3d-mesher-ld");
  EXPECT_EQ(argv.back(), "4");
}

TEST(LdAdapter, ItsSizeDialTurnsBothDistancesTogether) {
  const Adapter adapter = ld_adapter();
  const auto turned = with_size(*adapter.size_dial({}), 2.5, adapter.parameters.in({}), {});
  EXPECT_EQ(turned.at("mesh-to-image"), "2.5");
  EXPECT_EQ(turned.at("image-to-mesh"), "2.5");
}

}  // namespace
}  // namespace cbc3d::baselines
