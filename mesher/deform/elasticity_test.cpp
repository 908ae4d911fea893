// The linear system of the deformation: its solution and its materials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesher/deform/elasticity.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::paper_mesh;

TEST(Elasticity, SolvesToTheToleranceItTells) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 4});
  const VertexCells around = cells_of_vertices(mesh);
  ElasticityOptions options;
  options.solver.tolerance = 1e-6;
  ElasticSystem system(mesh, around, {{}, {}}, options);
  std::vector<std::uint8_t> sources(mesh.points.size(), 0);
  std::vector<Vec3> load(mesh.points.size());
  for (std::size_t v = 0; v < sources.size(); v += 7) {
    sources[v] = 1;
    load[v] = {0.1 * std::sin(static_cast<double>(v)), 0.2, -0.1};
  }
  system.assemble(mesh, sources);
  std::vector<Vec3> u(mesh.points.size());
  const SolveReport report = system.solve(load, u);
  EXPECT_GT(report.iterations, 0);
  std::vector<Vec3> product(u.size());
  system.multiply(u, product);
  double residual = 0;
  double scale = 0;
  for (std::size_t v = 0; v < u.size(); ++v) {
    residual += (load[v] - product[v]).squared_norm();
    scale += load[v].squared_norm();
  }
  EXPECT_LE(std::sqrt(residual / scale), 2e-6);
  EXPECT_LE(report.relative_residual, 1e-6);
  EXPECT_LE(system.solve(load, u).iterations, 2) << "a warm start has little to do";
}

TEST(Elasticity, StiffnessOfALabelIsItsOwn) {
  const LabelImage image = testing::ball_image(30, 1, 12, 6);
  const MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 4, .mixed = true});
  const VertexCells around = cells_of_vertices(mesh);
  const std::vector<std::uint8_t> none(mesh.points.size(), 0);
  std::vector<Vec3> u(mesh.points.size());
  for (std::size_t v = 0; v < u.size(); ++v) {
    u[v] = {std::sin(mesh.points[v].x), std::cos(mesh.points[v].y), 0.1 * mesh.points[v].z};
  }
  const auto force = [&](const std::vector<ElasticMaterial>& materials) {
    ElasticSystem system(mesh, around, materials, {});
    system.assemble(mesh, none);
    std::vector<Vec3> f(u.size());
    system.multiply(u, f);
    return f;
  };
  const auto soft = force({{}, {2100, 0.45}, {2100, 0.45}});
  const auto hard = force({{}, {2100, 0.45}, {8400, 0.45}});  // a factor that floats scale by exactly
  for (std::size_t v = 0; v < u.size(); ++v) {
    const auto cells = around.of(static_cast<VertexId>(v));
    const auto of = [&](MaterialId m) {
      return std::all_of(cells.begin(), cells.end(), [&](CellId c) { return mesh.material_of(c) == m; });
    };
    if (of(1)) {
      EXPECT_EQ(hard[v], soft[v]);
    } else if (of(2)) {
      EXPECT_EQ(hard[v], 4 * soft[v]);
    }
  }
}

}  // namespace
}  // namespace cbc3d
