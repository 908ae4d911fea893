#include "baselines/tetgen/adapter.hpp"

#include "baselines/core/testing_adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(TetgenAdapter, IsARepeatableProgramOfItsOwnUnderTheAgpl) {
  const std::vector<Adapter> adapters = tetgen_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  testing::expect_program_adapter(adapters[0], {.name = "tetgen", .licence = "AGPL-3.0-or-later"});
}

}  // namespace
}  // namespace cbc3d::baselines
