#include "baselines/ld/adapter.hpp"

#include "baselines/core/testing_adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(LdAdapter, IsARepeatableProgramOfOurOwn) {
  const std::vector<Adapter> adapters = ld_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  testing::expect_program_adapter(adapters[0],
                                  {.name = "ld", .licence = "Apache-2.0", .multithreaded = true});
}

TEST(LdAdapter, ItsSizeDialTurnsBothDistancesTogether) {
  const Adapter adapter = ld_adapters().front();
  const SizeDial dial = size_dial_of(adapter, {}).value();
  const auto turned = with_size(dial, 2.5, adapter.parameters.in({}), {});
  EXPECT_EQ(turned.at("mesh-to-image"), "2.5");
  EXPECT_EQ(turned.at("image-to-mesh"), "2.5");
}

}  // namespace
}  // namespace cbc3d::baselines
