#include "baselines/podm/adapter.hpp"

#include "baselines/core/testing_adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(PodmAdapter, IsAProgramOfItsOwnLicenceThatMoreThreadsHelp) {
  const std::vector<Adapter> adapters = podm_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  testing::expect_program_adapter(
      adapters[0],
      {.name = "podm", .licence = "GPL-3.0-or-later", .deterministic = false, .multithreaded = true});
}

TEST(PodmAdapter, ItsSizeDialIsDelta) {
  const Adapter adapter = podm_adapters().front();
  const SizeDial dial = size_dial_of(adapter, {}).value();
  EXPECT_EQ(with_size(dial, 2.5, adapter.parameters.in({}), {}).at("delta"), "2.5");
  EXPECT_LT(dial.exponent, 0);
}

}  // namespace
}  // namespace cbc3d::baselines
