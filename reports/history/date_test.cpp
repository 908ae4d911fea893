#include "reports/history/date.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

TEST(Date, IsUtcWhateverItsZone) {
  EXPECT_EQ(parse_date("2026-11-29"), "2026-11-29T00:00:00Z");
  EXPECT_EQ(parse_date("2026-11-29T08:05:09Z"), "2026-11-29T08:05:09Z");
  EXPECT_EQ(parse_date("2026-11-29T00:05:09+01:30"), "2026-11-28T22:35:09Z");
  EXPECT_EQ(parse_date("2026-12-31 23:30-0100"), "2027-01-01T00:30:00Z");
  EXPECT_EQ(parse_date("2024-02-29T08:05:09.123Z"), "2024-02-29T08:05:09Z");
}

TEST(Date, RefusesWhatIsNone) {
  for (const char* text : {"", "yesterday", "2026-13-01", "2026-02-29", "2026-11-29T25:00:00Z", "29.11.2026",
                           "2026-11-29T08:05:09Z; rm", "12026-11-29"}) {
    EXPECT_FALSE(parse_date(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace cbc3d::reports
