// A symmetric sparse matrix of 3x3 blocks, one block row a vertex, and conjugate gradients on it.
//
// Numbers are floats: the stiffness is a model parameter, and a displacement that is right to a
// ten-thousandth of a voxel is right. Sums over all vertices are kept in double.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "mesher/core/float4.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

/// A 3x3 matrix by columns.
struct Columns3 {
  Float4 c[3];

  /// Times a vector; lane 3 of the product is of no meaning.
  [[nodiscard]] Float4 times(const Float4& x) const {
    return spread<0>(x) * c[0] + spread<1>(x) * c[1] + spread<2>(x) * c[2];
  }
};

/// The inverse of a positive definite matrix; the identity where the determinant is not positive, as for a
/// vertex without stiffness.
Columns3 inverse_of(const Columns3& m);

class BlockMatrix {
 public:
  /// A block for every pair of vertices that share a cell and for each vertex itself, all of them to be set.
  BlockMatrix(const MaterialMesh& mesh, const VertexCells& around);

  [[nodiscard]] std::size_t row_count() const { return inverse_diagonal_.size(); }
  /// The columns of row v: v itself, then the others as they are met in the cells around it.
  [[nodiscard]] std::span<const VertexId> columns(VertexId v) const {
    return {column_.data() + first_[v], column_.data() + first_[v + 1]};
  }
  /// Sets the n-th block of row v.
  void set_block(VertexId v, std::size_t n, const Columns3& block) {
    float* const to = values_.get() + 9 * (first_[v] + n);
    block.c[0].store3(to);
    block.c[1].store3(to + 3);
    block.c[2].store3(to + 6);
  }
  /// Sets the inverse of the diagonal block of row v, for the preconditioner.
  void set_inverse_diagonal(VertexId v, const Columns3& inverse) { inverse_diagonal_[v] = inverse; }

  /// Row v times x; lane 3 is zero.
  [[nodiscard]] Float4 row_times(VertexId v, const std::vector<Float4>& x) const;
  [[nodiscard]] Float4 precondition(VertexId v, const Float4& r) const {
    return inverse_diagonal_[v].times(r);
  }

 private:
  std::vector<std::uint64_t> first_;
  std::vector<VertexId> column_;
  std::unique_ptr<float[]> values_;  ///< nine a block, by columns; one more, for the last is read as four
  std::vector<Columns3> inverse_diagonal_;
};

struct SolveOptions {
  /// The solver stops when the residual has fallen to this share of the load: a source is then within about a
  /// thousandth of where it is sent, and distances and angles of the mesh agree to four digits with those at
  /// 1e-5.
  double tolerance = 1e-3;
  int max_iterations = 300;  ///< of the conjugate gradients
};

struct SolveReport {
  int iterations = 0;
  double relative_residual = 0;  ///< |load - A u| / |load|
};

/// Solves A u = load, starting from the given u, by conjugate gradients with the diagonal blocks as
/// preconditioner. Sums are made in fixed order, so the result does not depend on the thread count.
SolveReport solve(const BlockMatrix& matrix, const std::vector<Vec3>& load, const SolveOptions& options,
                  std::vector<Vec3>& u);

}  // namespace cbc3d
