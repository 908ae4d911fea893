// The linear system of the deformation (paper, section "Mesh Deformation"):  (K + H^T H) U = H^T D.
//
// Notation: K  stiffness matrix of linear isotropic elasticity, N/mm (element_stiffness.hpp);
//           H  picks the source vertices (identity rows), so H^T H is 1 N/mm on their diagonal blocks;
//           D  displacements asked of the sources, mm;  U  displacements of all vertices, mm.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "mesher/stages/element_stiffness.hpp"
#include "mesher/stages/material_mesh.hpp"

namespace cbc3d {

struct ElasticityOptions {
  ElasticMaterial all;                        ///< of every label that has none of its own
  std::map<Label, ElasticMaterial> by_label;  ///< of single labels
  double tolerance = 1e-4;   ///< the solver stops when the residual has fallen by this factor
  int max_iterations = 300;  ///< of the conjugate gradients
};

struct SolveReport {
  int iterations = 0;
  double relative_residual = 0;  ///< |H^T D - (K + H^T H) U| / |H^T D|
};

/// Sparse matrix of 3x3 blocks in compressed rows. Blocks are floats: the stiffness is a model parameter, the
/// solution's accuracy is governed by the residual, which is computed with the same blocks in double.
class ElasticSystem {
 public:
  /// The sparsity pattern is that of the mesh and stays valid while its connectivity does. `around` must
  /// outlive the system. `materials`: one a MaterialId.
  ElasticSystem(const MaterialMesh& mesh, const VertexCells& around,
                const std::vector<ElasticMaterial>& materials, const ElasticityOptions& options);

  /// Computes K for the mesh's present coordinates and adds H^T H for the given sources (one flag a vertex).
  void assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source);

  /// Solves for U by conjugate gradients with 3x3 block-Jacobi preconditioning, starting from the given U.
  /// `load`: H^T D. Reductions are in fixed order, so the result does not depend on the thread count.
  SolveReport solve(const std::vector<Vec3>& load, std::vector<Vec3>& u) const;

  /// The vertices that share a cell with v, ascending, v itself among them.
  [[nodiscard]] std::span<const VertexId> neighbours(VertexId v) const {
    return {column_.data() + first_[v], column_.data() + first_[v + 1]};
  }
  /// y = (K + H^T H) x.
  void multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const;

 private:
  using Block = std::array<float, 9>;
  /// Reused by the rows of one thread.
  struct Scratch {
    std::vector<std::uint32_t> place;  ///< of a vertex in the row; valid for the row's columns
    std::vector<StiffnessBlock> sums;
    std::array<Vec3, 8> points;
    std::array<StiffnessBlock*, 8> row;
  };
  void assemble_upper_row(const MaterialMesh& mesh, VertexId v, bool source, Scratch& scratch);
  void mirror_lower_row(VertexId v);

  ElasticityOptions options_;
  const VertexCells& around_;
  std::vector<LameConstants> lame_;
  std::vector<std::uint64_t> first_;
  std::vector<VertexId> column_;
  std::vector<Block> blocks_;
  std::vector<std::array<double, 9>> inverse_diagonal_;
};

}  // namespace cbc3d
