#include <gtest/gtest.h>

#include <cmath>

#include "metrics/element_quality.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

const std::array<Vec3, 4> kRegular{Vec3{1, 1, 1}, Vec3{-1, 1, -1}, Vec3{1, -1, -1}, Vec3{-1, -1, 1}};
const std::array<Vec3, 4> kCorner{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
const std::array<Vec3, 4> kBcc{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{.5, .5, -.5}, Vec3{.5, .5, .5}};

std::array<Vec3, 8> unit_cube() {
  return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0},
          Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{1, 1, 1}, Vec3{0, 1, 1}};
}

std::array<Vec3, 5> pyramid(double height) {
  return {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}, Vec3{.5, .5, height}};
}

std::array<double, 6> sorted_angles(const std::array<Vec3, 4>& p) {
  auto angles = dihedral_angles_deg(p[0], p[1], p[2], p[3]);
  std::sort(angles.begin(), angles.end());
  return angles;
}

TEST(TetQuality, RegularTet) {
  const double expected = std::acos(1.0 / 3) * 180 / M_PI;
  for (const double angle : sorted_angles(kRegular)) EXPECT_NEAR(angle, expected, 1e-12);
  EXPECT_NEAR(std::fabs(scaled_jacobian_tet(kRegular)), 1, 1e-14);
}

TEST(TetQuality, CornerTet) {
  const auto angles = sorted_angles(kCorner);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(angles[a], std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-12);
  for (int a = 3; a < 6; ++a) EXPECT_NEAR(angles[a], 90, 1e-12);
  EXPECT_NEAR(scaled_jacobian_tet(kCorner), std::sqrt(.5), 1e-14);
}

TEST(TetQuality, BccTet) {
  const auto angles = sorted_angles(kBcc);
  for (int a = 0; a < 4; ++a) EXPECT_NEAR(angles[a], 60, 1e-12);
  for (int a = 4; a < 6; ++a) EXPECT_NEAR(angles[a], 90, 1e-12);
  EXPECT_NEAR(scaled_jacobian_tet(kBcc), .9428090415820634, 1e-14);
}

TEST(TetQuality, EveryAngleBelongsToItsEdge) {
  // A wedge of 30 degrees about the edge 0-1; the mirrored tet has the same angles and a negated Jacobian.
  const double s = std::sin(M_PI / 6), c = std::cos(M_PI / 6);
  const std::array<Vec3, 4> p{Vec3{0, 0, 0}, Vec3{0, 0, 1}, Vec3{1, 0, .2}, Vec3{c, s, .7}};
  EXPECT_NEAR(dihedral_angles_deg(p[0], p[1], p[2], p[3])[0], 30, 1e-12);
  EXPECT_NEAR(dihedral_angles_deg(p[2], p[3], p[0], p[1])[5], 30, 1e-12);
  EXPECT_NEAR(dihedral_angles_deg(p[0], p[2], p[1], p[3])[1], 30, 1e-12);
  EXPECT_NEAR(dihedral_angles_deg(p[0], p[2], p[3], p[1])[2], 30, 1e-12);
  EXPECT_NEAR(dihedral_angles_deg(p[2], p[0], p[1], p[3])[3], 30, 1e-12);
  EXPECT_NEAR(dihedral_angles_deg(p[2], p[0], p[3], p[1])[4], 30, 1e-12);
  EXPECT_EQ(scaled_jacobian_tet({p[0], p[1], p[3], p[2]}), -scaled_jacobian_tet(p));
}

TEST(TetQuality, RadiusRatioAndMeanRatio) {
  EXPECT_NEAR(radius_ratio_tet(kRegular), 1, 1e-14);
  EXPECT_NEAR(std::fabs(mean_ratio_tet(kRegular)), 1, 1e-14);
  // Right corner: circumradius sqrt(3)/2, inradius 1/(3 + sqrt(3)); V = 1/6, squared edges 3 * 1 + 3 * 2.
  EXPECT_NEAR(radius_ratio_tet(kCorner), std::sqrt(3.0) / 2 * (3 + std::sqrt(3.0)) / 3, 1e-14);
  EXPECT_NEAR(mean_ratio_tet(kCorner), 12 * std::pow(.5, 2.0 / 3) / 9, 1e-14);
  // BCC with long edge 1: circumradius sqrt(5)/4, V = 1/12, four faces of area sqrt(2)/4.
  EXPECT_NEAR(radius_ratio_tet(kBcc), std::sqrt(5.0) / 4 * (4 * std::sqrt(2.0) / 4) / (3 * 3 * (1.0 / 12)),
              1e-14);
  EXPECT_NEAR(mean_ratio_tet(kBcc), 12 * std::pow(.25, 2.0 / 3) / (2 * 1 + 4 * .75), 1e-14);
  const std::array<Vec3, 4> inverted{kBcc[1], kBcc[0], kBcc[2], kBcc[3]};
  EXPECT_EQ(mean_ratio_tet(inverted), -mean_ratio_tet(kBcc));
  EXPECT_NEAR(radius_ratio_tet(inverted), radius_ratio_tet(kBcc), 1e-14);
  const std::array<Vec3, 4> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_TRUE(std::isinf(radius_ratio_tet(flat)));
  EXPECT_EQ(mean_ratio_tet(flat), 0);
}

TEST(TetQuality, FlatTet) {
  const std::array<Vec3, 4> flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
  EXPECT_EQ(scaled_jacobian_tet(flat), 0);
  EXPECT_EQ(scaled_jacobian_tet({Vec3{}, Vec3{}, Vec3{}, Vec3{}}), 0);
  const auto angles = sorted_angles(flat);
  EXPECT_NEAR(angles[0], 0, 1e-12);
  EXPECT_NEAR(angles[5], 180, 1e-12);
}

TEST(OtherCells, Hex) {
  auto cube = unit_cube();
  EXPECT_NEAR(scaled_jacobian_hex(cube), 1, 1e-14);
  for (Vec3& p : cube) p.x += .5 * p.z;  // sheared: every corner has the volume 1 over 1 * 1 * sqrt(1.25)
  EXPECT_NEAR(scaled_jacobian_hex(cube), 1 / std::sqrt(1.25), 1e-14);
  for (Vec3& p : cube) p.z = -p.z;
  EXPECT_NEAR(scaled_jacobian_hex(cube), -1 / std::sqrt(1.25), 1e-14);
}

TEST(OtherCells, EveryHexCornerCounts) {
  for (std::size_t corner = 0; corner < 8; ++corner) {
    auto cube = unit_cube();
    const Vec3 centre{.5, .5, .5};
    cube[corner] = centre + 3 * (cube[corner] - centre);
    // Its edges are now (2,1,1) and the like: determinant 4, lengths sqrt(6).
    EXPECT_NEAR(scaled_jacobian_hex(cube), 4 / std::pow(6, 1.5), 1e-14) << corner;
    auto folded = unit_cube();
    folded[corner] = centre - 1.2 * (folded[corner] - centre);
    EXPECT_LT(scaled_jacobian_hex(folded), 0) << corner;
  }
}

TEST(OtherCells, PyramidInBothNorms) {
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid(.25)), .4714, 5e-5);
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid(.5)), .8165, 5e-5);
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid(std::sqrt(.5))), 1, 1e-12);
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid(1)), .9113, 5e-5);
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid(1.5)), .6578, 5e-5);
  EXPECT_NEAR(scaled_jacobian_pyramid_bcc(pyramid(.5)), 1, 1e-14);
  EXPECT_EQ(scaled_jacobian_pyramid(pyramid(-.5)), 0);
  EXPECT_NEAR(scaled_jacobian_pyramid_bcc(pyramid(-.5)), -1, 1e-14);
}

TEST(OtherCells, Wedge) {
  const double h = std::sqrt(3.0) / 2;
  std::array<Vec3, 6> wedge{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{.5, h, 0},
                            Vec3{0, 0, 2}, Vec3{1, 0, 2}, Vec3{.5, h, 2}};
  EXPECT_NEAR(scaled_jacobian_wedge(wedge), 1, 1e-14);
  for (Vec3& p : wedge) p.z = -p.z;
  EXPECT_NEAR(scaled_jacobian_wedge(wedge), -1, 1e-14);
}

TEST(Histogram, LatticeAnglesDoNotScatter) {
  EXPECT_EQ(dihedral_bin(60), 12U);
  EXPECT_EQ(dihedral_bin(std::nextafter(60.0, 0.0)), 12U);
  EXPECT_EQ(dihedral_bin(59.99), 11U);
  EXPECT_EQ(dihedral_bin(0), 0U);
  EXPECT_EQ(dihedral_bin(180), 35U);
}

TEST(Quality, MixedMeshAndItsInvertedTwin) {
  Mesh mesh;
  const auto cube = unit_cube();
  mesh.points.assign(cube.begin(), cube.end());
  mesh.points.push_back({.5, .5, 1.5});
  mesh.points.push_back({1.5, .5, .5});
  mesh.points.push_back({2.5, .5, .5});
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  mesh.pyramids.add({4, 5, 6, 7, 8}, 1);
  mesh.tets.add({1, 2, 5, 9}, 1);
  const LabelImage image = test::two_boxes();
  const auto good = test::judge(mesh, image)["quality"];
  EXPECT_EQ(good["inverted"], 0);
  EXPECT_NEAR(good["min_scaled_jacobian_hexes"].get<double>(), 1, 1e-14);
  EXPECT_NEAR(good["min_scaled_jacobian_pyramids"].get<double>(), std::sqrt(2.0 / 3), 1e-12);
  EXPECT_NEAR(good["min_scaled_jacobian_pyramids_bcc"].get<double>(), 1, 1e-14);
  EXPECT_TRUE(good["min_scaled_jacobian_wedges"].is_null());
  EXPECT_EQ(good["min_scaled_jacobian"], good["min_scaled_jacobian_tets"]);
  flip_orientation(mesh);
  const auto bad = test::judge(mesh, image)["quality"];
  EXPECT_EQ(bad["inverted"], 3);
  EXPECT_LT(bad["min_scaled_jacobian"].get<double>(), 0);
}

TEST(Quality, NoTetNoDihedral) {
  Mesh mesh;
  const auto cube = unit_cube();
  mesh.points.assign(cube.begin(), cube.end());
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  EXPECT_TRUE(quality["min_dihedral_deg"].is_null());
  EXPECT_EQ(quality["dihedral_histogram_5deg"].size(), 36U);
}

TEST(Histogram, PercentilesAreNearestRanks) {
  std::vector<float> values(200);  // 1 to 200, shuffled
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = static_cast<float>((n * 77) % 200 + 1);
  const auto found = percentiles_of(values);
  ASSERT_TRUE(found);
  for (std::size_t p = 0; p < kPercentiles.size(); ++p) EXPECT_EQ(found.value()[p], 2.0 * kPercentiles[p]);
  std::vector<float> one{3};
  EXPECT_EQ(percentiles_of(one).value().front(), 3.0);
  std::vector<float> none;
  EXPECT_FALSE(percentiles_of(none));
}

TEST(Quality, BlockOfTheBccLattice) {
  const Mesh mesh = test::bcc_block(4, 2.5, 1);
  ASSERT_EQ(mesh.tets.size(), 4U * 3 * 4 * 4 * 3);  // four around each face between two cells
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  const auto tets = static_cast<std::int64_t>(mesh.tets.size());
  EXPECT_EQ(quality["dihedral_histogram_5deg"][12], 4 * tets);
  EXPECT_EQ(quality["dihedral_histogram_5deg"][18], 2 * tets);
  EXPECT_NEAR(quality["min_dihedral_deg"].get<double>(), 60, 1e-9);
  EXPECT_NEAR(quality["max_dihedral_deg"].get<double>(), 90, 1e-9);
  EXPECT_NEAR(quality["dihedral_percentiles_deg"]["p50"].get<double>(), 60, 1e-4);
  EXPECT_NEAR(quality["dihedral_percentiles_deg"]["p75"].get<double>(), 90, 1e-4);
  EXPECT_NEAR(quality["min_scaled_jacobian"].get<double>(), 2 * std::sqrt(2.0) / 3, 1e-12);
  EXPECT_NEAR(quality["scaled_jacobian_percentiles"]["p99"].get<double>(), 2 * std::sqrt(2.0) / 3, 1e-6);
  EXPECT_NEAR(quality["max_radius_ratio"].get<double>(), 1.5 * std::sqrt(10.0) / 4.5, 1e-12);
  EXPECT_NEAR(quality["min_mean_ratio"].get<double>(), 2.4 * std::pow(.25, 2.0 / 3), 1e-12);
  EXPECT_EQ(quality["inverted"], 0);
  EXPECT_EQ(quality["degenerate"], 0);
}

TEST(Quality, EveryLabelHasItsOwnFigures) {
  Mesh mesh;
  mesh.points.assign(kBcc.begin(), kBcc.end());
  for (const Vec3& p : kCorner) mesh.points.push_back(p + Vec3{5, 0, 0});
  mesh.points.push_back({6, 1, 0});
  mesh.tets.add({0, 1, 2, 3}, 7);
  mesh.tets.add({4, 5, 6, 7}, 1);
  mesh.tets.add({4, 5, 8, 6}, 1);  // flat
  const auto quality = test::judge(mesh, test::two_boxes())["quality"];
  ASSERT_EQ(quality["per_label"].size(), 2U);
  const auto& one = quality["per_label"][0];
  const auto& seven = quality["per_label"][1];
  EXPECT_EQ(one["label"], 1);
  EXPECT_EQ(one["cells"], 2);
  EXPECT_EQ(one["degenerate"], 1);
  EXPECT_EQ(one["inverted"], 1);
  EXPECT_EQ(one["negative_jacobian"], 1);
  EXPECT_TRUE(one["max_radius_ratio"].is_null());  // infinite
  EXPECT_EQ(seven["inverted"], 0);
  EXPECT_NEAR(seven["min_dihedral_deg"].get<double>(), 60, 1e-9);
  EXPECT_EQ(quality["cells"], 3);
  EXPECT_EQ(quality["degenerate"], 1);
  EXPECT_EQ(quality["dihedral_histogram_5deg"][12], 4);
}

}  // namespace
}  // namespace cbc3d::metrics
