#include "reports/charts/chart.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cbc3d::reports {
namespace {

TEST(Chart, TicksAreThoseAPersonWouldChoose) {
  EXPECT_EQ(axis_ticks(0), (std::vector<double>{0, 1}));
  EXPECT_EQ(axis_ticks(10), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(axis_ticks(0.9).size(), 6U);
  EXPECT_GE(axis_ticks(123).back(), 123);
}

TEST(Chart, TextIsEscapedAndGapsAreLeftOut) {
  Chart chart;
  chart.title = "a < b & \"c\"";
  chart.categories = {"x", "y"};
  chart.series = {{"<one>", {1, std::numeric_limits<double>::quiet_NaN()}, {0.5, 0}, false}};
  for (const bool logarithmic : {false, true}) {
    chart.logarithmic = logarithmic;
    for (const std::string& svg : {bar_chart(chart), line_chart(chart)}) {
      EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
      EXPECT_EQ(svg.find("<one>"), std::string::npos);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace cbc3d::reports
