// Quality control of the deformation (paper, section "Quality control").
#pragma once

#include <span>
#include <vector>

#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct QualityOptions {
  double min_dihedral_deg = 5;       ///< smallest dihedral angle of a tet, degrees
  double min_scaled_jacobian = 0.2;  ///< of pyramids (normed to the BCC lattice's) and hexes
};

/// Judges the cells of a mesh that moves. A cell fails below the minimum quality, unless it was no better
/// before.
class QualityControl {
 public:
  /// Mesh and `around` must outlive the object.
  QualityControl(const MaterialMesh& mesh, const VertexCells& around, const QualityOptions& options);

  /// The failing cells after a move from `before` to `after`, ascending. Parallel.
  [[nodiscard]] std::vector<CellId> failing(const std::vector<Vec3>& before,
                                            const std::vector<Vec3>& after) const;

  /// Local step control: halves the displacements of the vertices of failing cells until no cell fails, and
  /// takes them back where four halvings do not do. It ends, at the latest with every vertex back. `failing`:
  /// what failing() said of before + displacement. Returns the number of vertices held back.
  std::size_t hold_back(const std::vector<Vec3>& before, std::vector<CellId> failing,
                        std::vector<Vec3>& displacement, std::vector<Vec3>& after) const;

 private:
  [[nodiscard]] double margin(CellId cell, const std::vector<Vec3>& points) const;
  /// Those of the cells around these vertices, each once; in any order. `seen`: one mark per cell, set to
  /// `round`.
  [[nodiscard]] std::vector<CellId> failing_around(const std::vector<VertexId>& vertices,
                                                   const std::vector<Vec3>& before,
                                                   const std::vector<Vec3>& after,
                                                   std::vector<std::uint32_t>& seen,
                                                   std::uint32_t round) const;
  [[nodiscard]] std::vector<CellId> those_that_fail(std::span<const CellId> cells,
                                                    const std::vector<Vec3>& before,
                                                    const std::vector<Vec3>& after) const;
  [[nodiscard]] bool fails(CellId cell, const std::vector<Vec3>& before,
                           const std::vector<Vec3>& after) const;

  const MaterialMesh& mesh_;
  const VertexCells& around_;
  double max_cosine_;
  double min_scaled_jacobian_;
};

}  // namespace cbc3d
