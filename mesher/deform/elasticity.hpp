// The linear system of the deformation (paper, section "Mesh Deformation"):  (K + H^T H) U = H^T D.
//
// Notation: K  stiffness matrix of linear isotropic elasticity, N/mm (element_stiffness.hpp);
//           H  picks the source vertices (identity rows), so H^T H is 1 N/mm on their diagonal blocks;
//           D  displacements asked of the sources, mm;  U  displacements of all vertices, mm.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "mesher/deform/block_matrix.hpp"
#include "mesher/deform/element_stiffness.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct ElasticityOptions {
  ElasticMaterial all;                        ///< of every label that has none of its own
  std::map<Label, ElasticMaterial> by_label;  ///< of single labels
  SolveOptions solver;
};

class ElasticSystem {
 public:
  /// The sparsity pattern is that of the mesh and stays valid while its connectivity does. `around` must
  /// outlive the system. `materials` has one entry per MaterialId.
  ElasticSystem(const MaterialMesh& mesh, const VertexCells& around,
                const std::vector<ElasticMaterial>& materials, const ElasticityOptions& options);

  /// Computes K for the mesh's present coordinates and adds H^T H for the given sources (one flag per
  /// vertex).
  void assemble(const MaterialMesh& mesh, const std::vector<std::uint8_t>& is_source);

  /// Solves for U, starting from the given U. `load`: H^T D.
  SolveReport solve(const std::vector<Vec3>& load, std::vector<Vec3>& u) const {
    return cbc3d::solve(matrix_, load, options_.solver, u);
  }

  [[nodiscard]] const BlockMatrix& matrix() const { return matrix_; }
  /// y = (K + H^T H) x.
  void multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y) const;

 private:
  /// Reused by the rows of one thread.
  struct Scratch {
    std::vector<std::uint32_t> place;  ///< of a vertex in the row; valid for the row's columns
    /// By block: Q = sum of mu g_v g_n^T over tets, which gives ratio Q + Q^T + tr(Q) I.
    std::vector<Columns3> q;
    std::vector<Columns3> rest;  ///< by block, unless one_ratio_: what the other terms of Q do not give
    std::array<Vec3, 8> points;
    std::array<StiffnessBlock, 8> row;
  };
  void assemble_row(const MaterialMesh& mesh, VertexId v, bool source, Scratch& scratch);
  void add_tet(const MaterialMesh& mesh, CellId tet, VertexId v, Scratch& scratch) const;
  void add_other_cell(const MaterialMesh& mesh, CellId cell, VertexId v, Scratch& scratch) const;

  ElasticityOptions options_;
  const VertexCells& around_;
  std::vector<LameConstants> lame_;
  bool one_ratio_ = true;  ///< all materials have one ratio lambda / mu, and all cells are tets
  float ratio_ = 0;        ///< that ratio; 0 without one
  std::size_t tet_count_;
  std::unique_ptr<TetGradients[]> shape_;  ///< of tets
  BlockMatrix matrix_;
};

}  // namespace cbc3d
