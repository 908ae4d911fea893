#include "mesher/mesh_formats/file_mesh.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "mesher/mesh_formats/labelled_interfaces.hpp"

namespace cbc3d {

std::vector<std::size_t> cells_by_label(const FileCells& cells) {
  std::vector<std::size_t> numbers(cells.size());
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::stable_sort(numbers.begin(), numbers.end(),
                   [&](std::size_t a, std::size_t b) { return cells.labels[a] < cells.labels[b]; });
  return numbers;
}

std::string interface_name(const Interface& interface, const LabelNames& names, bool from_other_side) {
  const std::string label = names.identifier(interface.label);
  const std::string other = interface.other ? names.identifier(*interface.other) : "exterior";
  return from_other_side ? other + "__" + label : label + "__" + other;
}

template <int Nodes>
void FileMesh::add_block(const CellBlock<Nodes>& block, CellKind kind) {
  if (block.size() == 0) return;
  static_assert(sizeof(block.nodes[0]) == Nodes * sizeof(VertexId));
  blocks_.push_back({kind, Nodes, {block.nodes.data()->data(), Nodes * block.size()}, block.labels});
}

FileMesh::FileMesh(const Mesh& mesh, const FileMeshOptions& options) : points_(mesh.points) {
  labels_ = labels_of(mesh);
  add_block(mesh.tets, CellKind::tet);
  add_block(mesh.pyramids, CellKind::pyramid);
  add_block(mesh.wedges, CellKind::wedge);
  add_block(mesh.hexes, CellKind::hex);
  complete(options);
}

FileMesh::FileMesh(const QuadraticMesh& mesh, const FileMeshOptions& options) : points_(mesh.points) {
  labels_ = mesh.tets.labels;
  std::sort(labels_.begin(), labels_.end());
  labels_.erase(std::unique(labels_.begin(), labels_.end()), labels_.end());
  add_block(mesh.tets, CellKind::tet);
  complete(options);
}

/// Interfaces are those of the shared nodes: once the nodes are apart, every facet is an outer one.
void FileMesh::complete(const FileMeshOptions& options) {
  if (options.interfaces) {
    interfaces_ = labelled_interfaces(blocks_, points_.size());
  }
  if (options.split) {
    split_nodes();
  }
}

std::size_t FileMesh::cell_count() const {
  std::size_t count = 0;
  for (const FileCells& block : blocks_) count += block.size();
  return count;
}

std::size_t FileMesh::nodes_of(const CellFacet& facet, std::span<VertexId, 6> nodes) const {
  std::size_t cell = facet.cell;
  const FileCells* block = blocks_.data();
  for (; cell >= block->size(); ++block) cell -= block->size();
  const auto all = block->nodes_of(cell);
  const FacetCorners& corners = row_of(block->kind).facet[facet.number];
  const std::size_t count = corners[3] == kNoCorner ? 3 : 4;
  for (std::size_t n = 0; n < count; ++n) nodes[n] = all[corners[n]];
  if (!block->is_quadratic()) return count;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint8_t a = corners[n], b = corners[(n + 1) % 3];
    const auto edge = std::find_if(
        kQuadraticTetEdges.begin(), kQuadraticTetEdges.end(),
        [&](const auto& ends) { return (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a); });
    nodes[3 + n] = all[static_cast<std::size_t>(4 + (edge - kQuadraticTetEdges.begin()))];
  }
  return 6;
}

/// A node keeps its number in the cells of its lowest label; every other label has a new one, numbered as the
/// cells come.
void FileMesh::split_nodes() {
  std::vector<Label> lowest(points_.size(), std::numeric_limits<Label>::max());
  for (const FileCells& block : blocks_) {
    for (std::size_t n = 0; n < block.nodes.size(); ++n) {
      Label& label = lowest[block.nodes[n]];
      label = std::min(label, block.labels[n / block.nodes_per_cell]);
    }
  }
  own_points_.assign(points_.begin(), points_.end());
  std::unordered_map<std::uint64_t, VertexId> twins;
  for (FileCells& block : blocks_) {
    std::vector<VertexId>& nodes = own_nodes_.emplace_back(block.nodes.begin(), block.nodes.end());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Label label = block.labels[n / block.nodes_per_cell];
      if (label == lowest[nodes[n]]) continue;
      const std::uint64_t key = std::uint64_t{nodes[n]} << 32U | static_cast<std::uint32_t>(label);
      const auto [twin, added] = twins.emplace(key, static_cast<VertexId>(own_points_.size()));
      if (added) own_points_.push_back(points_[nodes[n]]);
      nodes[n] = twin->second;
    }
    block.nodes = nodes;
  }
  points_ = own_points_;
  split_ = true;
}

}  // namespace cbc3d
