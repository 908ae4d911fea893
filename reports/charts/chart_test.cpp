#include "reports/charts/chart.hpp"
#include "mesher/testing/count_of.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cbc3d::reports {
namespace {

using cbc3d::testing::count_of;

TEST(Chart, TicksAreThoseAPersonWouldChoose) {
  EXPECT_EQ(axis_ticks(0), (std::vector<double>{0, 1}));
  EXPECT_EQ(axis_ticks(10), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(axis_ticks(0.9).size(), 6U);
  EXPECT_GE(axis_ticks(123).back(), 123);
}

TEST(Chart, TicksBetweenHoldBothEnds) {
  EXPECT_EQ(axis_ticks_between(101, 109), (std::vector<double>{100, 102, 104, 106, 108, 110}));
  for (const auto& [lowest, highest] : {std::pair{-3.0, -1.0}, {5.0, 5.0}, {0.0, 0.0}, {-1e-3, 1e6}}) {
    const std::vector<double> ticks = axis_ticks_between(lowest, highest);
    EXPECT_LE(ticks.front(), lowest);
    EXPECT_GE(ticks.back(), highest);
    EXPECT_GE(ticks.size(), 2U);
    EXPECT_LE(ticks.size(), 8U);
  }
}

TEST(Chart, MarkersStandAcrossThePlotAndAreEscaped) {
  Chart chart;
  chart.categories = {"a", "b", "c", "d"};
  chart.series = {{"one", {100, 101, 108, 109}, {}, false}};
  chart.from_zero = false;
  chart.markers = {{2, "+8 <%>", "tip & more", true}};
  const std::string svg = line_chart(chart);
  EXPECT_NE(svg.find("+8 &lt;%&gt;"), std::string::npos);
  EXPECT_NE(svg.find("<title>tip &amp; more</title>"), std::string::npos);
  EXPECT_NE(svg.find("x1=\"357.00\""), std::string::npos) << "in the middle of the plot, 70 to 644";
  EXPECT_EQ(svg.find(">0</text>"), std::string::npos) << "the axis is near the values";
  chart.from_zero = true;
  EXPECT_NE(line_chart(chart).find(">0</text>"), std::string::npos);
}

TEST(Chart, EverySeriesIsAGroupWithItsEntryInTheLegend) {
  Scatter scatter;
  scatter.x_title = "distance (mm)";
  scatter.y_title = "angle (deg)";
  scatter.series = {{"one", {{1, 10}, {2, 20}}, {"liver, one <b>", "liver, one, again"}},
                    {"two", {{3, 30000}}}};
  const std::string svg = scatter_chart(scatter);
  EXPECT_EQ(count_of(svg, "class=\"series\""), 2U);
  EXPECT_EQ(count_of(svg, "class=\"key\""), 2U);
  EXPECT_EQ(count_of(svg, "data-series=\"1\""), 2U);
  EXPECT_EQ(count_of(svg, "class=\"mark point\""), 3U);
  EXPECT_NE(svg.find("<title>liver, one &lt;b&gt;&#10;distance (mm): 1&#10;angle (deg): 10</title>"),
            std::string::npos);
  EXPECT_NE(svg.find("<title>two&#10;distance (mm): 3&#10;angle (deg): 30,000</title>"), std::string::npos);
  Chart chart;
  chart.categories = {"liver"};
  chart.y_title = "time (s)";
  chart.series = {{"one", {5}, {0.5}, false}};
  for (const std::string& drawn : {bar_chart(chart), line_chart(chart)}) {
    EXPECT_EQ(count_of(drawn, "class=\"series\""), 1U);
    EXPECT_NE(drawn.find("<title>one, liver&#10;time (s): 5 ± 0.5</title>"), std::string::npos);
  }
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
