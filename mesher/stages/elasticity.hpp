// The linear system of the deformation (paper, section "Mesh Deformation"):  (K + H^T H) U = H^T D.
//
// Notation: K  stiffness matrix of linear isotropic elasticity on the tets, N/mm;
//           H  picks the source vertices (identity rows), so H^T H is 1 N/mm on their diagonal blocks;
//           D  displacements asked of the sources, mm;  U  displacements of all vertices, mm.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/stages/material_mesh.hpp"

namespace cbc3d {

struct ElasticityOptions {
  double young_pa = 2100;    ///< Young's modulus, Pa (as the paper's ancestor had it)
  double poisson = 0.45;     ///< Poisson's ratio, in [0, 0.5)
  double tolerance = 1e-5;   ///< the solver stops when the residual has fallen by this factor
  int max_iterations = 300;  ///< of the conjugate gradients
};

struct SolveReport {
  int iterations = 0;
  double relative_residual = 0;
};

/// Sparse matrix of 3x3 blocks in compressed rows. Blocks are floats: the stiffness is a model parameter, the
/// solution's accuracy is governed by the residual, which is computed with the same blocks in double.
class ElasticSystem {
 public:
  /// The sparsity pattern is that of the mesh and stays valid while its connectivity does.
  ElasticSystem(const MaterialMesh& mesh, const ElasticityOptions& options);

  /// Computes K for the mesh's present coordinates and adds H^T H for the given sources (one flag a vertex).
  void assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source);

  /// Solves for U by conjugate gradients with 3x3 block-Jacobi preconditioning, starting from the given U.
  /// `load`: H^T D. Reductions are in fixed order, so the result does not depend on the thread count.
  SolveReport solve(const std::vector<Vec3>& load, std::vector<Vec3>& u) const;

 private:
  using Block = std::array<float, 9>;
  void assemble_row(const MaterialMesh& mesh, std::size_t v, bool source);
  void multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const;

  ElasticityOptions options_;
  VertexTets around_;
  std::vector<std::uint32_t> first_;
  std::vector<VertexId> column_;
  std::vector<Block> blocks_;
  std::vector<std::array<double, 9>> inverse_diagonal_;
};

}  // namespace cbc3d
