// Sparse symmetric systems: conjugate gradients, and the largest eigenvalue.
//
// Notation: K matrix, b right-hand side, x solution, D the diagonal of K.
#pragma once

#include <Eigen/SparseCore>
#include <cstddef>

namespace cbc3d::solver {

/// Whole, not a triangle of it, row by row: so a product is the same at any thread count.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

struct Solution {
  Eigen::VectorXd x;
  std::ptrdiff_t iterations = 0;
};

/// What conjugate gradients are stopped at by default: |b - K x| / |b|.
inline constexpr double kResidual = 1e-8;

/// Solves K x = b by conjugate gradients with Jacobi's preconditioner, from x = 0, until |b - K x| <=
/// residual |b|. K may be singular where b is in its range. Throws JobError when the residual is not reached.
Solution solve(const SparseMatrix& matrix, const Eigen::VectorXd& right_side, double residual = kResidual);

/// The largest eigenvalue of D^-1/2 K D^-1/2, which has no unit and does not depend on the coefficients'
/// scale: the upper end of the spectrum that conjugate gradients see with Jacobi's preconditioner. By
/// Lanczos' method from a fixed start, to six digits. 0 for a system without unknowns.
double largest_scaled_eigenvalue(const SparseMatrix& matrix);

/// The largest eigenvalue of K itself.
double largest_eigenvalue(const SparseMatrix& matrix);

}  // namespace cbc3d::solver
