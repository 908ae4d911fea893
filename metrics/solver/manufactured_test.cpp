#include "metrics/solver/manufactured.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <vector>

#include "mesher/core/error.hpp"
#include "metrics/solver/testing.hpp"

namespace cbc3d::solver {
namespace {

const Box kUnitBox{{0, 0, 0}, {1, 1, 1}};

ErrorFigures poisson_error(const Mesh& mesh, const PoissonOptions& options) {
  return solve_poisson(FiniteElementMesh(mesh, "test"), options).error;
}

ErrorFigures elasticity_error(const Mesh& mesh, const ElasticityOptions& options) {
  return solve_elasticity(FiniteElementMesh(mesh, "test"), options).error;
}

std::vector<Mesh> patches() {
  return {test::cube_of_tets(4, .2), test::cube_of_all_kinds(6, .15)};
}

// The patch test (Irons and Razzaque 1972): what the elements hold exactly must come out exactly, whatever
// their shape.
TEST(PatchTest, PoissonIsExactForLinearFieldsOnDistortedCellsOfAllKinds) {
  for (const Mesh& mesh : patches()) {
    for (const int order : {1, 2}) {
      const ErrorFigures error = poisson_error(
          mesh, {.order = order, .box = kUnitBox, .exact = "1+2*X(1)-X(2)+.5*X(3)", .residual = 1e-13});
      EXPECT_LT(error.h1_relative, 1e-10) << order;
      EXPECT_LT(error.l2_relative, 1e-10) << order;
    }
  }
}

TEST(PatchTest, PoissonOfOrderTwoIsExactForQuadraticFieldsOnDistortedTets) {
  const ErrorFigures error =
      poisson_error(test::cube_of_tets(3, .2),
                    {.order = 2, .box = kUnitBox, .exact = "X(1)*X(2)-2*sqr(X(3))+X(1)", .residual = 1e-13});
  EXPECT_LT(error.h1_relative, 1e-10);
}

TEST(PatchTest, ElasticityIsExactForLinearFieldsOnDistortedCellsOfAllKinds) {
  for (const Mesh& mesh : patches()) {
    for (const int order : {1, 2}) {
      ElasticityOptions options{.order = order,
                                .box = kUnitBox,
                                .exact = "[X(1)+2*X(2);X(3)-X(1);.5*X(2)-X(3)+1]",
                                .residual = 1e-13};
      options.poisson_ratio.values[2] = .45;
      const ErrorFigures error = elasticity_error(mesh, options);
      EXPECT_LT(error.h1_relative, 1e-10) << order;
      EXPECT_LT(error.l2_relative, 1e-10) << order;
    }
  }
}

TEST(PatchTest, AllKindsMakeOneConformingMesh) {
  const Mesh mesh = test::cube_of_all_kinds(6);
  ASSERT_TRUE(mesh.tets.size() > 0 && mesh.pyramids.size() > 0 && mesh.wedges.size() > 0 &&
              mesh.hexes.size() > 0);
  FiniteElementMesh cells(mesh, "test");
  // Quads at the four sides; at the top two triangles per wedge, at the bottom also two per cube of pyramids.
  const std::size_t sides = 4 * 36, top = 12 + 24 + 12, bottom = 12 + 24 + 24;
  EXPECT_EQ(cells.cells().region(FiniteElementMesh::kBoundary).size(), sides + top + bottom);
}

/// Orders of convergence between neighbours in a list of errors of meshes, each twice as fine as the one
/// before it.
template <typename Solve>
void expect_orders(const std::vector<int>& sizes, double h1_order, double l2_order, const Solve& solve_on) {
  ErrorFigures coarse;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const ErrorFigures fine = solve_on(test::cube_of_tets(sizes[i]));
    // The first meshes are too coarse for a limit.
    if (i + 2 >= sizes.size()) {
      EXPECT_NEAR(std::log2(coarse.h1_relative / fine.h1_relative), h1_order, .1) << sizes[i];
      EXPECT_NEAR(std::log2(coarse.l2_relative / fine.l2_relative), l2_order, .1) << sizes[i];
    }
    coarse = fine;
  }
}

ErrorFigures gentle_poisson(const Mesh& mesh, int order) {
  return poisson_error(mesh, {.order = order, .box = kUnitBox, .exact = "exp(X(1))*sin(X(2)+.5)*cos(X(3))"});
}

ErrorFigures gentle_elasticity(const Mesh& mesh, int order) {
  return elasticity_error(mesh, {.order = order,
                                 .box = kUnitBox,
                                 .exact = "[sin(X(1))*cos(X(2));cos(X(2)+X(3));exp(.5*X(3))*sin(X(1)+1)]"});
}

TEST(Convergence, PoissonOfOrderOneFallsByHAndHSquared) {
  expect_orders({2, 4, 8, 16, 32}, 1, 2, [](const Mesh& mesh) { return gentle_poisson(mesh, 1); });
}

TEST(Convergence, PoissonOfOrderTwoFallsByHSquaredAndHCubed) {
  expect_orders({1, 2, 4, 8, 16}, 2, 3, [](const Mesh& mesh) { return gentle_poisson(mesh, 2); });
}

TEST(Convergence, ElasticityFallsLikePoisson) {
  expect_orders({2, 4, 8, 16}, 1, 2, [](const Mesh& mesh) { return gentle_elasticity(mesh, 1); });
  expect_orders({1, 2, 4, 8}, 2, 3, [](const Mesh& mesh) { return gentle_elasticity(mesh, 2); });
}

TEST(Figures, AreThoseOfTheMeshWhateverTheUnitOrTheThreads) {
  Mesh mesh = test::cube_of_tets(5, .2);
  const auto figures_of = [](const Mesh& m) {
    const FiniteElementMesh cells(m, "test");
    return solve_poisson(cells, {.box = cells.box()});
  };
  omp_set_num_threads(1);
  const ProblemFigures alone = figures_of(mesh);
  omp_set_num_threads(4);
  const ProblemFigures together = figures_of(mesh);
  EXPECT_EQ(alone.error.h1_relative, together.error.h1_relative);
  EXPECT_EQ(alone.solve.lambda_max, together.solve.lambda_max);
  EXPECT_EQ(alone.solve.unknowns, 64U);
  for (Vec3& p : mesh.points) {
    p *= 1024;
  }
  const ProblemFigures large = figures_of(mesh);
  EXPECT_NEAR(large.error.h1_relative, alone.error.h1_relative, 1e-9);
  EXPECT_NEAR(large.solve.lambda_max, alone.solve.lambda_max, 1e-9);
  EXPECT_NEAR(large.solve.lambda_max_h_scaled, alone.solve.lambda_max_h_scaled, 1e-6);
}

// Four nodes of a tet share its energy, so four is a bound of the scaled eigenvalue (Fried 1972, Wathen
// 1987).
TEST(Figures, TheScaledEigenvalueKeepsItsBoundAndTheUnscaledOneGrowsWithFlatTets) {
  const auto figures_of = [](double flattening) {
    Mesh mesh = test::cube_of_tets(6);
    for (Vec3& p : mesh.points) {
      p.z *= flattening;
    }
    return solve_poisson(FiniteElementMesh(mesh, "test"), {.box = kUnitBox}).solve;
  };
  const SolveFigures regular = figures_of(1), flat = figures_of(.05);
  EXPECT_LT(regular.lambda_max, 4);
  EXPECT_LT(flat.lambda_max, 4);
  EXPECT_GT(flat.lambda_max_h_scaled, 10 * regular.lambda_max_h_scaled);
}

TEST(Figures, AMeshWithoutInnerVertexHasNoUnknown) {
  const FiniteElementMesh cells(test::cube_of_tets(1), "test");
  const ProblemFigures figures = solve_poisson(cells, {.box = kUnitBox});
  EXPECT_EQ(figures.solve.unknowns, 0U);
  EXPECT_EQ(figures.solve.lambda_max, 0);
  EXPECT_GT(figures.error.h1_relative, .1);
}

TEST(Figures, VerticesAtOnePlaceStayApart) {
  Mesh mesh = test::cube_of_tets(1);
  const Mesh other = mesh;
  for (const Vec3& p : other.points) {
    mesh.points.push_back(p + Vec3{1, 0, 0});
  }
  for (const auto& c : other.tets.nodes) {
    mesh.tets.add({c[0] + 8, c[1] + 8, c[2] + 8, c[3] + 8}, 1);
  }
  const FiniteElementMesh cells(mesh, "test");
  Galerkin method(cells, 1, 1, {});
  EXPECT_EQ(method.dof_count(), 16U);
}

std::string complaint(const Mesh& mesh) {
  try {
    const FiniteElementMesh cells(mesh, "some.vtu");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(BadMesh, IsNamedInOneLine) {
  EXPECT_NE(complaint({}).find("some.vtu: no volume cell"), std::string::npos);
  Mesh inverted = test::cube_of_tets(2);
  std::swap(inverted.tets.nodes[3][0], inverted.tets.nodes[3][1]);
  EXPECT_NE(complaint(inverted).find("some.vtu: 1 inverted, flat or folded tets (the first is number 3"),
            std::string::npos);
  Mesh twice = test::cube_of_tets(2);
  twice.tets.add(twice.tets.nodes[5], 1);
  EXPECT_NE(complaint(twice).find("two cells have the same vertices"), std::string::npos);
  test::Grid folded(1, 0);
  folded.mesh.hexes.add(folded.cube(0, 0, 0), 1);
  folded.mesh.points[folded.at(1, 1, 1)] = {-1, -1, -1};
  EXPECT_NE(complaint(folded.mesh).find("hexes"), std::string::npos);
}

TEST(BadMaterial, IsNamed) {
  const FiniteElementMesh cells(test::cube_of_tets(2), "test");
  PoissonOptions poisson{.box = kUnitBox};
  poisson.conductivity.values[2] = 0;
  EXPECT_THROW(solve_poisson(cells, poisson), InputError);
  ElasticityOptions elasticity{.box = kUnitBox};
  elasticity.poisson_ratio.values[2] = .5;
  EXPECT_THROW(solve_elasticity(cells, elasticity), InputError);
  EXPECT_THROW(solve_poisson(cells, PoissonOptions{}), InputError) << "no box";
}

}  // namespace
}  // namespace cbc3d::solver
