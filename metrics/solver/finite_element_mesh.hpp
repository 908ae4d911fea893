// A labelled mesh as GetFEM takes it: its cells, their labels, its boundary and the interfaces of two labels.
#pragma once

#include <getfem/getfem_mesh.h>

#include <string>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d::solver {

/// Axis-aligned box, mm.
struct Box {
  Vec3 lower, upper;

  [[nodiscard]] double longest_side() const { return (upper - lower).max_coeff(); }
};

/// The smallest box around the vertices that cells use.
Box bounding_box(const Mesh& mesh);

class FiniteElementMesh {
 public:
  /// Faces that one cell alone has: the outer surface and the walls of cavities.
  static constexpr getfem::size_type kBoundary = 1;
  /// Faces between two labels, once from each side.
  static constexpr getfem::size_type kInterfaces = 2;
  /// Numbers from here on are free for a problem's own regions.
  static constexpr getfem::size_type kFirstFreeRegion = 3;

  /// Throws InputError, naming `name`, when the mesh has no cell, a cell twice, or a cell whose Jacobian is
  /// not positive at every corner: no finite-element figure has a meaning on it.
  FiniteElementMesh(const Mesh& mesh, const std::string& name);

  [[nodiscard]] const getfem::mesh& cells() const { return cells_; }
  [[nodiscard]] getfem::mesh& cells() { return cells_; }
  [[nodiscard]] Label label_of(getfem::size_type cell) const { return labels_[cell]; }
  [[nodiscard]] const std::vector<Label>& labels() const { return labels_; }
  [[nodiscard]] const Box& box() const { return box_; }
  /// Cube root of the mean cell volume, mm.
  [[nodiscard]] double mean_size_mm() const { return mean_size_mm_; }
  /// Tets, whose map from the reference cell is affine; the other kinds' is not.
  [[nodiscard]] const dal::bit_vector& tets() const { return tets_; }

 private:
  template <int Nodes>
  void add_cells(const CellBlock<Nodes>& block, const bgeot::pgeometric_trans& map,
                 const std::array<int, Nodes>& order, const std::string& name);
  void find_faces();

  getfem::mesh cells_;
  std::vector<Label> labels_;
  dal::bit_vector tets_;
  Box box_;
  double mean_size_mm_ = 0;
};

}  // namespace cbc3d::solver
