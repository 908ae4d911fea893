// A mesh as writers see it: any kinds of cells, linear or quadratic, their interfaces, nodes shared or apart.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/cell_kinds.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {

/// Cells of one kind with as many nodes each.
struct FileCells {
  CellKind kind = CellKind::tet;
  std::size_t nodes_per_cell = 4;  ///< 10 for quadratic tets
  std::span<const VertexId> nodes;
  std::span<const Label> labels;

  [[nodiscard]] std::size_t size() const { return labels.size(); }
  [[nodiscard]] std::span<const VertexId> nodes_of(std::size_t cell) const {
    return nodes.subspan(cell * nodes_per_cell, nodes_per_cell);
  }
  [[nodiscard]] bool is_quadratic() const { return nodes_per_cell == 10; }
  [[nodiscard]] const CellKindRow& row() const { return is_quadratic() ? kQuadraticTet : row_of(kind); }
};

/// The numbers of the cells, those of a label together, labels ascending.
std::vector<std::size_t> cells_by_label(const FileCells& cells);

/// A facet by a cell that it belongs to; cells are numbered through all blocks.
struct CellFacet {
  std::uint32_t cell;
  std::uint8_t number;  ///< of CellKindRow::facet
};

/// The facets between two labels, or between a label and the outside.
struct Interface {
  Label label = 0;
  std::optional<Label> other;       ///< a higher label; none for the outside
  std::vector<CellFacet> facets;    ///< of cells of `label`, so that normals point out of it
  std::vector<CellFacet> opposite;  ///< the same facets in the same order, of cells of `other`
};

/// What a file calls the interface: "liver__vessel", "liver__exterior"; from the other side "vessel__liver".
std::string interface_name(const Interface& interface, const LabelNames& names, bool from_other_side = false);

struct FileMeshOptions {
  bool interfaces = true;  ///< they are found
  bool split = false;      ///< every label has nodes of its own at its interfaces
};

class FileMesh {
 public:
  /// The mesh must outlive this. Throws InputError where interfaces are to be found and a facet belongs to
  /// more than two cells.
  FileMesh(const Mesh& mesh, const FileMeshOptions& options);
  FileMesh(const QuadraticMesh& mesh, const FileMeshOptions& options);
  FileMesh(const FileMesh&) = delete;
  FileMesh& operator=(const FileMesh&) = delete;

  [[nodiscard]] std::span<const Vec3> points() const { return points_; }
  [[nodiscard]] const std::vector<FileCells>& blocks() const { return blocks_; }  ///< none is empty
  [[nodiscard]] const std::vector<Label>& labels() const { return labels_; }      ///< ascending, distinct
  [[nodiscard]] const std::vector<Interface>& interfaces() const { return interfaces_; }  ///< by labels
  [[nodiscard]] bool is_split() const { return split_; }
  [[nodiscard]] std::size_t cell_count() const;
  [[nodiscard]] bool is_quadratic() const { return !blocks_.empty() && blocks_.front().is_quadratic(); }

  /// The nodes of a facet counter-clockwise seen from outside its cell: 3 or 4 corners, 6 of a quadratic tet
  /// (corners, then the edges between them in turn). Returns how many.
  std::size_t nodes_of(const CellFacet& facet, std::span<VertexId, 6> nodes) const;

 private:
  template <int Nodes>
  void add_block(const CellBlock<Nodes>& block, CellKind kind);
  void complete(const FileMeshOptions& options);
  void split_nodes();

  std::span<const Vec3> points_;
  std::vector<FileCells> blocks_;
  std::vector<Label> labels_;
  std::vector<Interface> interfaces_;
  bool split_ = false;
  // What a split mesh has of its own.
  std::vector<Vec3> own_points_;
  std::vector<std::vector<VertexId>> own_nodes_;
};

}  // namespace cbc3d
