// Cells of any kind behind one numbering, their faces, and their split into tetrahedra.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::metrics {

enum class CellKind : std::uint8_t { kTet, kPyramid, kWedge, kHex };

/// Faces of a kind of cell: local node numbers, counter-clockwise seen from outside; -1 ends a triangle.
struct CellShape {
  int face_count;
  std::array<std::array<int, 4>, 6> faces;
};

const CellShape& shape_of(CellKind kind);

/// One cell of a mesh.
struct CellView {
  CellKind kind;
  std::span<const VertexId> nodes;
};

/// Tetrahedra a cell is split into, at most six.
struct TetSplit {
  int count = 0;
  std::array<std::array<VertexId, 4>, 6> tets;
};

/// Splits a cell by joining its lowest-numbered vertex with the faces that do not hold it, a quad being cut
/// by the diagonal at its lowest-numbered vertex. Both cells at a quad so cut it alike, hence the splits of a
/// conforming mesh conform. Tets of a positive convex cell are positive.
TetSplit split_into_tets(const CellView& cell);

/// A mesh seen from an image: cells numbered through (tets, pyramids, wedges, hexes in this order), positions
/// in the image's local frame, labels as dense indices.
class MeshView {
 public:
  /// Throws InputError when a cell names a vertex that does not exist or a coordinate is not finite.
  MeshView(const Mesh& mesh, const LabelImage& image);

  [[nodiscard]] const Mesh& mesh() const { return *mesh_; }
  /// Vertex positions in the image's local frame, mm. In a left-handed frame positive cells appear mirrored.
  [[nodiscard]] const std::vector<Vec3>& local_points() const { return local_points_; }
  /// Distinct cell labels, ascending.
  [[nodiscard]] const std::vector<Label>& labels() const { return labels_; }
  [[nodiscard]] std::size_t cell_count() const { return cell_label_.size(); }
  /// Index into labels() of a cell's label.
  [[nodiscard]] std::uint32_t label_index(std::size_t cell) const { return cell_label_[cell]; }
  [[nodiscard]] CellView cell(std::size_t cell) const;
  /// Index into labels() of a label value; nothing when no cell has it.
  [[nodiscard]] std::optional<std::uint32_t> find_label(Label label) const;

 private:
  const Mesh* mesh_;
  std::array<std::size_t, 4> first_;  // number of the first cell of each kind
  std::vector<Vec3> local_points_;
  std::vector<Label> labels_;
  std::vector<std::uint32_t> cell_label_;
};

}  // namespace cbc3d::metrics
