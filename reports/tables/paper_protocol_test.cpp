#include "reports/tables/paper_protocol.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(PaperProtocol, IsThatOfThePapersTables) {
  EXPECT_EQ(paper_images().size(), 4U);
  const auto& patterns = paper_patterns();
  for (std::size_t n = 1; n < patterns.size(); ++n) {  // more points come nearer and take longer
    EXPECT_GT(patterns[n].target_points, patterns[n - 1].target_points);
    EXPECT_LT(patterns[n].hausdorff_mm, patterns[n - 1].hausdorff_mm);
    EXPECT_GT(patterns[n].seconds, patterns[n - 1].seconds);
  }
  EXPECT_LT(patterns.front().hausdorff_mm, kPaperHausdorffBeforeMm);
  EXPECT_FALSE(paper_parameters().empty());
}

}  // namespace
}  // namespace cbc3d::reports
