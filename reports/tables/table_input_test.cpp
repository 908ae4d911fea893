#include "reports/tables/table_input.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(TableInput, CasesAreFoundByName) {
  std::vector<cases::Case> cases(2);
  cases[1].name = "ball";
  EXPECT_EQ(find_case(cases, "ball"), &cases[1]);
  EXPECT_EQ(find_case(cases, "box"), nullptr);
}

}  // namespace
}  // namespace cbc3d::reports
