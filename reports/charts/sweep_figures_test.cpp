#include "reports/charts/sweep_figures.hpp"

#include <gtest/gtest.h>

#include "reports/sweep/testing_sweep.hpp"

namespace cbc3d::reports {
namespace {

TEST(SweepFigures, AreOneForTimesSpeedUpAndStages) {
  const std::vector<Figure> figures = sweep_figures(sweep_points(decode_lines(sweep_lines())));
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[1].name, "sweep-speed-up-box");
  for (const Figure& figure : figures) {
    EXPECT_EQ(figure.svg.find("nan"), std::string::npos) << figure.name;
    EXPECT_NE(figure.svg.find("</svg>"), std::string::npos);
  }
}

}  // namespace
}  // namespace cbc3d::reports
