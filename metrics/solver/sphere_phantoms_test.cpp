#include "metrics/solver/sphere_phantoms.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "mesher/core/error.hpp"
#include "metrics/solver/testing.hpp"

namespace cbc3d::solver {
namespace {

const Vec3 kCentre{5, -3, 10};

/// Brain, skull and scalp, with 2^level layers of cells in all.
Mesh head(int level) {
  std::vector<double> radii{0};
  std::vector<Label> labels;
  const int unit = 1 << (level - 1);
  test::append_radii(radii, labels, 78, 3 * unit, 1);
  test::append_radii(radii, labels, 84, unit, 2);
  test::append_radii(radii, labels, 92, unit, 3);
  return test::layered_ball(level, radii, labels, kCentre);
}

DipoleSphereOptions head_options(int order, const Vec3& moment) {
  DipoleSphereOptions options{.order = order, .centre_mm = kCentre, .layers = {{1, 78}, {2, 84}, {3, 92}}};
  options.conductivity.values = {{1, .33}, {2, .0165}, {3, .33}};
  options.dipole_place_mm = kCentre + Vec3{0, 24, 32};
  options.dipole_moment = moment;
  return options;
}

TEST(DipoleSphere, ConvergesToTheSeries) {
  for (const Vec3& moment : {Vec3{0, .6, .8}, {1, 0, 0}}) {
    for (const int order : {1, 2}) {
      double rdm = 2, size_error = 1, potential = 2;
      for (const int level : {1, 2, 3}) {
        if (order == 2 && level == 3) {
          continue;
        }
        const auto figures =
            solve_dipole_sphere(FiniteElementMesh(head(level), "head"), head_options(order, moment));
        EXPECT_LT(figures.rdm, rdm / 2) << "level " << level << ", order " << order;
        EXPECT_LT(std::abs(figures.mag - 1), size_error / 2) << "level " << level << ", order " << order;
        EXPECT_LT(figures.potential_relative, potential / 2) << "level " << level << ", order " << order;
        rdm = figures.rdm, size_error = std::abs(figures.mag - 1), potential = figures.potential_relative;
      }
      EXPECT_LT(rdm, .03) << order;
      EXPECT_LT(potential, .05) << order;
    }
  }
}

TEST(DipoleSphere, AskingTheImpossibleIsRefused) {
  const FiniteElementMesh mesh(head(1), "head");
  DipoleSphereOptions options = head_options(1, {1, 0, 0});
  options.layers.pop_back();
  EXPECT_THROW(solve_dipole_sphere(mesh, options), InputError) << "label 3 has no layer";
  options = head_options(1, {0, 0, 0});
  EXPECT_THROW(solve_dipole_sphere(mesh, options), InputError) << "no moment";
  options = head_options(1, {1, 0, 0});
  options.conductivity.values.erase(2);
  EXPECT_THROW(solve_dipole_sphere(mesh, options), InputError) << "no conductivity";
}

Mesh shell(int level) {
  std::vector<double> radii{20};
  std::vector<Label> labels;
  const int unit = 1 << (level - 1);
  test::append_radii(radii, labels, 30, unit, 1);
  test::append_radii(radii, labels, 40, unit, 2);
  return test::layered_ball(level, radii, labels, kCentre);
}

PressurisedSphereOptions shell_options(int order, double poisson_ratio) {
  PressurisedSphereOptions options{
      .order = order, .centre_mm = kCentre, .cavity_radius_mm = 20, .layers = {{1, 30}, {2, 40}}};
  options.young.values = {{1, 1}, {2, 4}};
  options.poisson_ratio.values = {{1, poisson_ratio}, {2, .3}};
  return options;
}

/// Errors of meshes each twice as fine as the one before it: they fall, at last by half or nearly so.
void expect_convergence(const std::vector<double>& errors, const char* what) {
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    EXPECT_LT(errors[i + 1], errors[i]) << what << " " << i;
  }
  EXPECT_LT(errors.back(), errors[errors.size() - 2] / 1.6) << what;
}

// Linear elements lock as the inner layer comes near to incompressible; quadratic ones do not.
TEST(PressurisedSphere, ConvergesToLame) {
  for (const double poisson_ratio : {.3, .49}) {
    for (const int order : {1, 2}) {
      std::vector<double> displacement, slope, stress, radial;
      for (int level = 1; level <= (order == 1 ? 3 : 2); ++level) {
        FiniteElementMesh mesh(shell(level), "shell");
        const auto figures = solve_pressurised_sphere(mesh, shell_options(order, poisson_ratio));
        displacement.push_back(figures.problem.error.l2_relative);
        slope.push_back(figures.problem.error.h1_relative);
        stress.push_back(figures.interface_stress_relative);
        radial.push_back(figures.interface_radial_stress_relative);
      }
      SCOPED_TRACE(testing::Message() << "Poisson's ratio " << poisson_ratio << ", order " << order);
      expect_convergence(displacement, "displacement");
      expect_convergence(slope, "slope");
      expect_convergence(stress, "stress");
      expect_convergence(radial, "radial stress");
      EXPECT_LT(displacement.back(), .04);
    }
  }
}

TEST(PressurisedSphere, AMeshWithoutCavityIsRefused) {
  FiniteElementMesh mesh(head(1), "head");
  PressurisedSphereOptions options = shell_options(1, .3);
  EXPECT_THROW(solve_pressurised_sphere(mesh, options), InputError);
}

}  // namespace
}  // namespace cbc3d::solver
