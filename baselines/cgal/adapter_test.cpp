#include "baselines/cgal/adapter.hpp"

#include "baselines/core/testing_adapter.hpp"

namespace cbc3d::baselines {
namespace {

TEST(CgalAdapters, OnlyTheParallelOneIsNotRepeatable) {
  const std::vector<Adapter> adapters = cgal_adapters();
  ASSERT_EQ(adapters.size(), 2U);
  testing::expect_program_adapter(adapters[0], {.name = "cgal", .licence = "GPL-3.0-or-later"});
  testing::expect_program_adapter(adapters[1], {.name = "cgal-parallel",
                                                .licence = "GPL-3.0-or-later",
                                                .deterministic = false,
                                                .multithreaded = true});
}

}  // namespace
}  // namespace cbc3d::baselines
