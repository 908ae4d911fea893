#include "metrics/solver/linear_system.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <vector>

#include "mesher/core/error.hpp"

namespace cbc3d::solver {

namespace {

/// Numbers in [-1, 1) that look random and are always the same (Steele et al., "Fast splittable pseudorandom
/// number generators", 2014): a start that no eigenvector is orthogonal to.
Eigen::VectorXd fixed_start(Eigen::Index size) {
  Eigen::VectorXd start(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    std::uint64_t z = (static_cast<std::uint64_t>(i) + 1) * 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    start[i] = static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-52 - 1;
  }
  return start.normalized();
}

double largest_of_tridiagonal(const std::vector<double>& diagonal, const std::vector<double>& beside) {
  const auto size = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), size),
                                Eigen::Map<const Eigen::VectorXd>(beside.data(), size - 1),
                                Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[size - 1];
}

/// The largest eigenvalue of S K S with S = diag(scale). Lanczos' recurrence without reorthogonalisation:
/// what it loses are copies of eigenvalues already found, never the largest itself (Paige 1980).
double lanczos(const SparseMatrix& matrix, const Eigen::VectorXd& scale) {
  constexpr std::size_t kMostSteps = 1000, kStepsBetweenChecks = 10;
  constexpr double kRelativeChange = 1e-8;
  std::vector<double> alpha, beta;
  Eigen::VectorXd now = fixed_start(matrix.rows()), before = Eigen::VectorXd::Zero(matrix.rows()), next;
  const std::size_t most = std::min(kMostSteps, static_cast<std::size_t>(matrix.rows()));
  double found = 0;
  for (std::size_t step = 1; step <= most; ++step) {
    next = scale.cwiseProduct(matrix * scale.cwiseProduct(now));
    if (!beta.empty()) {
      next -= beta.back() * before;
    }
    alpha.push_back(now.dot(next));
    next -= alpha.back() * now;
    const double norm = next.norm();
    const bool exhausted = step == most || norm <= 1e-14 * std::abs(alpha.front());
    if (exhausted || step % kStepsBetweenChecks == 0) {
      const double largest = largest_of_tridiagonal(alpha, beta);
      if (exhausted || std::abs(largest - found) <= kRelativeChange * largest) {
        return largest;
      }
      found = largest;
    }
    beta.push_back(norm);
    before.swap(now);
    now = next / norm;
  }
  return found;
}

}  // namespace

Solution solve(const SparseMatrix& matrix, const Eigen::VectorXd& right_side, double residual) {
  if (matrix.rows() == 0) {
    return {};
  }
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper> method;
  method.setTolerance(residual);
  method.setMaxIterations(std::max<Eigen::Index>(10000, matrix.rows()));
  method.compute(matrix);
  Solution solution;
  solution.x = method.solve(right_side);
  solution.iterations = method.iterations();
  if (method.info() != Eigen::Success) {
    std::ostringstream reason;
    reason << "conjugate gradients: a relative residual of " << method.error() << " after "
           << method.iterations() << " iterations instead of " << residual
           << "; the mesh may have a cell that is nearly flat, or loose parts";
    throw JobError(reason.str());
  }
  return solution;
}

double largest_scaled_eigenvalue(const SparseMatrix& matrix) {
  return matrix.rows() == 0 ? 0 : lanczos(matrix, matrix.diagonal().cwiseSqrt().cwiseInverse());
}

double largest_eigenvalue(const SparseMatrix& matrix) {
  return matrix.rows() == 0 ? 0 : lanczos(matrix, Eigen::VectorXd::Ones(matrix.rows()));
}

}  // namespace cbc3d::solver
