#include "baselines/tetgen/adapter.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines {
namespace {

TEST(TetgenAdapter, IsARepeatableProgramOfItsOwnUnderTheAgpl) {
  const std::vector<Adapter> adapters = tetgen_adapters();
  ASSERT_EQ(adapters.size(), 1U);
  EXPECT_EQ(adapters[0].licence, "AGPL-3.0-or-later");
  EXPECT_TRUE(adapters[0].deterministic);
  const auto argv = adapters[0].command("bin", {"in.nii", "out.vtu", "r.json", 3, {{"max-volume", "4"}}});
  EXPECT_EQ(argv.front(), "bin/cbc3d-mesher-tetgen");
  EXPECT_EQ(argv.back(), "4");
}

}  // namespace
}  // namespace cbc3d::baselines
