// Stars of a mesh that stays, and their worst angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "mesher/improve/local/mesh_star.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d {
namespace {

TEST(MeshStar, HoldsTheTetsOfTheVertex) {
  const testing::KuhnBox box(3);
  const VertexCells around = tets_of_vertices(box.tets, box.points.size());
  for (VertexId v = 0; v < box.points.size(); ++v) {
    std::vector<TetId> wanted;
    for (TetId t = 0; t < box.tets.size(); ++t) {
      if (std::count(box.tets[t].begin(), box.tets[t].end(), v) > 0) wanted.push_back(t);
    }
    const auto star = around.of(v);
    EXPECT_EQ(std::vector<TetId>(star.begin(), star.end()), wanted);
  }
}

TEST(MeshStar, ItsQualityIsThatOfItsWorstTet) {
  const testing::KuhnBox box(2);
  MaterialMesh mesh{box.points, box.tets, std::vector<MaterialId>(box.tets.size(), 1), {}, {}};
  std::vector<TetId> all(mesh.tets.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_NEAR(worst_sine_squared(mesh), quality_of_deg(45), 1e-12);  // Kuhn's tets
  EXPECT_EQ(worst_quality(mesh, {}), 1);
  EXPECT_LE(worst_quality(mesh), worst_sine_squared(mesh));
  mesh.points[13] = {1, 1, 1.9};  // the middle vertex, near the top
  double least = 1;
  for (const TetId t : all) least = std::min(least, worst_quality(mesh, {&t, 1}));
  EXPECT_LT(least, quality_of_deg(20));
  EXPECT_EQ(worst_quality(mesh, all), least);
  EXPECT_EQ(worst_quality(mesh), least);
  mesh.points[13] = {1, 1, 2.5};
  EXPECT_EQ(worst_quality(mesh, all), -1);  // some are inside out
}

}  // namespace
}  // namespace cbc3d
