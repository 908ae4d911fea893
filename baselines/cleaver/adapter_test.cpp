#include "baselines/cleaver/adapter.hpp"

#include "baselines/core/testing_adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(CleaverAdapter, IsARepeatableProgramOfOurOwn) {
  const std::vector<Adapter> adapters = cleaver_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  testing::expect_program_adapter(adapters[0],
                                  {.name = "cleaver", .licence = "Apache-2.0", .multithreaded = true});
}

TEST(CleaverAdapter, MoreSamplesAreMoreElements) {
  const SizeDial dial = size_dial_of(cleaver_adapters().front(), {}).value();
  EXPECT_EQ(dial.parameter, "sampling-rate");
  EXPECT_GT(dial.exponent, 0);
}

}  // namespace
}  // namespace cbc3d::baselines
