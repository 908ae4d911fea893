#include "baselines/cgal/adapter.hpp"

#include <gtest/gtest.h>

namespace cbc3d::baselines {
namespace {

TEST(CgalAdapters, OnlyTheParallelOneIsNotRepeatable) {
  const std::vector<Adapter> adapters = cgal_adapters();
  ASSERT_EQ(adapters.size(), 2U);
  EXPECT_EQ(adapters[0].name, "cgal");
  EXPECT_TRUE(adapters[0].deterministic);
  EXPECT_FALSE(adapters[0].multithreaded);
  EXPECT_EQ(adapters[1].name, "cgal-parallel");
  EXPECT_FALSE(adapters[1].deterministic);
  EXPECT_TRUE(adapters[1].multithreaded);
}

TEST(CgalAdapters, TheProgramIsNamedAfterTheMesher) {
  for (const Adapter& adapter : cgal_adapters()) {
    const auto argv = adapter.command("bin", {"in.nii", "out.vtu", "r.json", 3, {{"cell-size", "4"}}});
    EXPECT_EQ(argv.front(), "bin/cbc3d-mesher-" + adapter.name);
    EXPECT_EQ(argv.back(), "4");
    EXPECT_EQ(adapter.licence, "GPL-3.0-or-later");
  }
}

}  // namespace
}  // namespace cbc3d::baselines
