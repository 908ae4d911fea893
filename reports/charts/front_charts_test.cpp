#include "reports/charts/front_charts.hpp"

#include <gtest/gtest.h>

#include "reports/charts/testing_tips.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Json budget_line(const std::string& mesher, int budget, double seconds, double distance_mm) {
  Json line = job_line("liver", mesher, budget);
  line["budget"] = budget;
  line["time_s"]["cpu"] = seconds;
  line["quality"]["inner_vertices"] = budget / 6;
  line["fidelity"]["mean_distance_mm"] = distance_mm;
  return line;
}

const Figure* find(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures)
    if (figure.name == name) return &figure;
  return nullptr;
}

TEST(FrontCharts, EveryFigureIsDrawnOverElementsUnknownsAndSeconds) {
  const auto figures =
      front_charts(decode_lines({budget_line("cgal", 1000, 1, 0.5), budget_line("cgal", 4000, 3, 0.1),
                                 budget_line("cbc3d", 1000, 2, 0.25)}));
  for (const char* axis : {"elements", "unknowns", "seconds"}) {
    const Figure* figure = find(figures, std::string("front-liver-fidelity-mean-distance-mm-") + axis);
    ASSERT_NE(figure, nullptr) << axis;
    EXPECT_NE(figure->svg.find("<path"), std::string::npos);
    EXPECT_EQ(figure->svg.find("nan"), std::string::npos);
    EXPECT_EQ(figure->svg.find("inf"), std::string::npos);
  }
  EXPECT_NE(find(figures, "front-liver-time-s-cpu-elements"), nullptr);
  EXPECT_EQ(find(figures, "front-liver-time-s-cpu-seconds"), nullptr);
  const std::string tip = test::tip_of(find(figures, "front-liver-fidelity-mean-distance-mm-unknowns")->svg,
                                       "liver, cgal, asked for 4,000 elements");
  EXPECT_NE(tip.find(": 666&#10;"), std::string::npos) << tip;
  EXPECT_TRUE(tip.ends_with(": 0.1")) << tip;
}

TEST(FrontCharts, ARunWithoutBudgetsHasNone) {
  EXPECT_TRUE(front_charts(decode_lines({job_line("liver", "cgal", 100)})).empty());
}

}  // namespace
}  // namespace cbc3d::reports
