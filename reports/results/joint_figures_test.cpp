#include "reports/results/joint_figures.hpp"

#include <gtest/gtest.h>

namespace cbc3d::reports {
namespace {

using metrics::Figures;
using metrics::metric_id;

Figures figures(double cpu_s, double reference_s, double angle_deg) {
  Figures one;
  one[metric_id("time_s.cpu")] = cpu_s;
  one[metric_id("time_s.reference_cpu")] = reference_s;
  one[metric_id("quality.min_dihedral_deg")] = angle_deg;
  return one;
}

TEST(JointFigures, AreTheMedianOrTheLeastAndDeriveFromThese) {
  const Figures a = figures(6, .2, 10), b = figures(3, .1, 11), c = figures(4, .3, 40);
  const Figures joint = joint_figures({&a, &b, &c});
  EXPECT_EQ(joint[metric_id("quality.min_dihedral_deg")], 11);
  EXPECT_EQ(joint[metric_id("time_s.cpu")], 3);
  EXPECT_EQ(joint[metric_id("time_s.reference_cpu")], .1);
  EXPECT_DOUBLE_EQ(joint[metric_id("time_ratio")].value(), 30);
  EXPECT_FALSE(joint[metric_id("counts.tets")].has_value());
}

}  // namespace
}  // namespace cbc3d::reports
