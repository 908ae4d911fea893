#include "metrics/solver/linear_system.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>

#include "mesher/core/error.hpp"

namespace cbc3d::solver {
namespace {

/// The Laplacian of a line, -1 2 -1, with diagonal scaled by `scale(i)` on both sides.
SparseMatrix line(int size, double (*scale)(int)) {
  SparseMatrix matrix(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = std::max(0, i - 1); j <= std::min(size - 1, i + 1); ++j) {
      matrix.insert(i, j) = (i == j ? 2 : -1) * scale(i) * scale(j);
    }
  }
  matrix.makeCompressed();
  return matrix;
}

double one(int /*i*/) {
  return 1;
}
double uneven(int i) {
  return 1 + i % 7;
}

// The eigenvalues of the line are 2 - 2 cos(k pi / (size + 1)).
TEST(LinearSystem, LargestEigenvalueOfALineIsTheKnownOne) {
  for (const int size : {1, 2, 5, 50, 400}) {
    const double exact = 2 + 2 * std::cos(std::numbers::pi / (size + 1));
    EXPECT_NEAR(largest_eigenvalue(line(size, one)), exact, 1e-5) << size;
    EXPECT_NEAR(largest_scaled_eigenvalue(line(size, one)), exact / 2, 1e-5) << size;
    EXPECT_NEAR(largest_scaled_eigenvalue(line(size, uneven)), exact / 2, 1e-5) << size;
  }
  EXPECT_EQ(largest_scaled_eigenvalue(SparseMatrix(0, 0)), 0);
}

// Conjugate gradients end in the step for the last of the eigenvalues in the right-hand side; the steps
// before it are counted.
TEST(LinearSystem, IterationsFollowTheEigenvaluesOfTheRightSide) {
  constexpr int kSize = 60;
  const SparseMatrix matrix = line(kSize, one);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(kSize);
  for (int count = 1; count <= 4; ++count) {
    for (int i = 0; i < kSize; ++i) {
      right_side[i] += std::sin(std::numbers::pi * (9 * count) * (i + 1) / (kSize + 1));
    }
    EXPECT_EQ(solve(matrix, right_side).iterations, count - 1);
  }
}

TEST(LinearSystem, SolutionsAreTheSameBytesAtAnyThreadCount) {
  const SparseMatrix matrix = line(500, uneven);
  const Eigen::VectorXd right_side = Eigen::VectorXd::LinSpaced(500, 0, 1);
  omp_set_num_threads(1);
  const Solution alone = solve(matrix, right_side);
  omp_set_num_threads(4);
  const Solution together = solve(matrix, right_side);
  EXPECT_EQ(alone.iterations, together.iterations);
  EXPECT_TRUE((alone.x.array() == together.x.array()).all());
  EXPECT_LE((matrix * alone.x - right_side).norm(), 1.01 * kResidual * right_side.norm());
}

TEST(LinearSystem, ASystemWithoutSolutionIsAJobThatFails) {
  SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = matrix.insert(1, 1) = 1;
  matrix.insert(0, 1) = matrix.insert(1, 0) = -1;
  EXPECT_THROW(solve(matrix, Eigen::Vector2d(1, 1)), JobError);
}

}  // namespace
}  // namespace cbc3d::solver
