// What the tests of the adapters on program_adapter() have in common.
#pragma once

#include <gtest/gtest.h>

#include "baselines/core/adapter.hpp"

namespace cbc3d::baselines::testing {

/// What a table says of a mesher besides its figures.
struct AdapterFacts {
  std::string name;
  std::string licence;
  bool deterministic = true;
  bool multithreaded = false;
};

/// Checks the facts, that the program is named after the mesher, and that it is given a parameter.
inline void expect_program_adapter(const Adapter& adapter, const AdapterFacts& facts) {
  SCOPED_TRACE(facts.name);
  EXPECT_EQ(adapter.name, facts.name);
  EXPECT_EQ(adapter.licence, facts.licence);
  EXPECT_EQ(adapter.deterministic, facts.deterministic);
  EXPECT_EQ(adapter.multithreaded, facts.multithreaded);
  const std::string& parameter = adapter.parameters.in("bin").front().key;
  const auto argv = adapter.command("bin", {"in.nii", "out.vtu", "r.json", 3, {{parameter, "0.4"}}});
  EXPECT_EQ(argv.front(), "bin/cbc3d-mesher-" + facts.name);
  ASSERT_GE(argv.size(), 2U);
  EXPECT_EQ(argv[argv.size() - 2], "--" + parameter);
  EXPECT_EQ(argv.back(), "0.4");
}

}  // namespace cbc3d::baselines::testing
