// A sparse matrix of blocks against a dense one.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesher/deform/block_matrix.hpp"
#include "mesher/testing/mixed_cubes.hpp"
#include "mesher/testing/random_draws.hpp"
#include "mesher/testing/thread_counts.hpp"

namespace cbc3d {
namespace {

using Dense = std::map<std::pair<VertexId, VertexId>, Mat3>;

Columns3 columns_of(const Mat3& m) {
  return {{Float4(m.column(0)), Float4(m.column(1)), Float4(m.column(2))}};
}

TEST(BlockMatrix, InversesOfPositiveDefiniteBlocks) {
  std::mt19937 random(1);
  for (int n = 0; n < 100; ++n) {
    const Mat3 half{{testing::draw_point(random, -1, 1), testing::draw_point(random, -1, 1),
                     testing::draw_point(random, -1, 1)}};
    Mat3 m = half * half.transposed();
    for (int d = 0; d < 3; ++d) m(d, d) += 0.5;
    const Columns3 inverse = inverse_of(columns_of(m));
    const Vec3 x = testing::draw_point(random, -1, 1);
    EXPECT_LT((inverse.times(Float4(m * x)).xyz() - x).norm(), 1e-5);
  }
  const Columns3 none = inverse_of(columns_of(Mat3{}));  // the identity, for a vertex without stiffness
  EXPECT_EQ(none.times(Float4(Vec3{1, 2, 3})).xyz(), (Vec3{1, 2, 3}));
}

/// Symmetric, with a heavy diagonal.
Dense random_values(const MaterialMesh& mesh, const BlockMatrix& matrix) {
  std::mt19937 random(3);
  Dense dense;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    for (const VertexId w : matrix.columns(v)) {
      if (w < v) continue;
      Mat3 block{{testing::draw_point(random, -1, 1), testing::draw_point(random, -1, 1),
                  testing::draw_point(random, -1, 1)}};
      if (w == v) {
        block = block * block.transposed();
        for (int d = 0; d < 3; ++d) block(d, d) += 80;
      }
      dense[{v, w}] = block;
      dense[{w, v}] = w == v ? block : block.transposed();
    }
  }
  return dense;
}

TEST(BlockMatrix, RowsAreTheVerticesOfTheCellsAndSolutionsSolve) {
  const MaterialMesh mesh = testing::mixed_cubes(5);
  const VertexCells around = cells_of_vertices(mesh);
  BlockMatrix matrix(mesh, around);
  ASSERT_EQ(matrix.row_count(), mesh.points.size());
  for (VertexId v = 0; v < matrix.row_count(); ++v) {
    std::set<VertexId> wanted = {v};
    for (const CellId c : around.of(v)) wanted.insert(mesh.nodes_of(c).begin(), mesh.nodes_of(c).end());
    const auto columns = matrix.columns(v);
    EXPECT_EQ(columns[0], v);
    EXPECT_EQ(columns.size(), wanted.size());
    EXPECT_EQ(std::set<VertexId>(columns.begin(), columns.end()), wanted);
  }
  Dense dense = random_values(mesh, matrix);
  for (VertexId v = 0; v < matrix.row_count(); ++v) {
    for (std::size_t n = 0; n < matrix.columns(v).size(); ++n) {
      matrix.set_block(v, n, columns_of(dense[{v, matrix.columns(v)[n]}]));
    }
    matrix.set_inverse_diagonal(v, inverse_of(columns_of(dense[{v, v}])));
  }
  std::mt19937 random(4);
  std::vector<Vec3> wanted(mesh.points.size());
  for (Vec3& x : wanted) x = testing::draw_point(random, -1, 1);
  std::vector<Vec3> load(wanted.size());
  for (const auto& [at, block] : dense) load[at.first] += block * wanted[at.second];
  const std::vector<Float4> x(wanted.begin(), wanted.end());
  for (VertexId v = 0; v < matrix.row_count(); ++v) {
    EXPECT_LT((matrix.row_times(v, x).xyz() - load[v]).norm(), 1e-4);
    EXPECT_EQ(matrix.row_times(v, x)[3], 0);
  }
  std::vector<std::vector<Vec3>> solutions;
  testing::at_thread_counts([&] {
    std::vector<Vec3> u(wanted.size());
    const SolveReport report = solve(matrix, load, {1e-5, 300}, u);
    EXPECT_GT(report.iterations, 0);
    EXPECT_LE(report.relative_residual, 1e-5);
    for (std::size_t v = 0; v < u.size(); ++v) EXPECT_LT((u[v] - wanted[v]).norm(), 1e-3);
    solutions.push_back(u);
    EXPECT_EQ(u, solutions[0]);  // the same at any thread count
  });
}

}  // namespace
}  // namespace cbc3d
