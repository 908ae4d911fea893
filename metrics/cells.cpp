#include "metrics/cells.hpp"

#include <algorithm>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::metrics {
namespace {

constexpr std::array<CellShape, 4> kShapes{{
    {4, {{{1, 2, 3, -1}, {0, 3, 2, -1}, {0, 1, 3, -1}, {0, 2, 1, -1}}}},
    {5, {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}},
    {5, {{{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
    {6, {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}},
}};

template <int Nodes>
void require_known_vertices(const CellBlock<Nodes>& block, std::size_t points, const char* kind) {
  for (std::size_t c = 0; c < block.size(); ++c) {
    for (const VertexId v : block.nodes[c]) {
      if (v >= points) {
        throw InputError("mesh: " + std::string(kind) + " " + std::to_string(c) + " names vertex " +
                         std::to_string(v) + " of " + std::to_string(points) + "; write the mesh again");
      }
    }
  }
}

void require_sound(const Mesh& mesh) {
  require_known_vertices(mesh.tets, mesh.points.size(), "tet");
  require_known_vertices(mesh.pyramids, mesh.points.size(), "pyramid");
  require_known_vertices(mesh.wedges, mesh.points.size(), "wedge");
  require_known_vertices(mesh.hexes, mesh.points.size(), "hex");
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (!mesh.points[v].all_finite()) {
      throw InputError("mesh: vertex " + std::to_string(v) +
                       " has a coordinate that is not finite; make the mesh again");
    }
  }
}

}  // namespace

const CellShape& shape_of(CellKind kind) {
  return kShapes[static_cast<std::size_t>(kind)];
}

TetSplit split_into_tets(const CellView& cell) {
  TetSplit split;
  if (cell.kind == CellKind::kTet) {
    split.count = 1;
    std::copy_n(cell.nodes.begin(), 4, split.tets[0].begin());
    return split;
  }
  const CellShape& shape = shape_of(cell.kind);
  const VertexId lowest = *std::min_element(cell.nodes.begin(), cell.nodes.end());
  for (int f = 0; f < shape.face_count; ++f) {
    std::array<VertexId, 4> face{};
    int corners = 0;
    for (const int local : shape.faces[static_cast<std::size_t>(f)]) {
      if (local >= 0) {
        face[static_cast<std::size_t>(corners++)] = cell.nodes[static_cast<std::size_t>(local)];
      }
    }
    const auto end = face.begin() + corners;
    if (std::find(face.begin(), end, lowest) != end) {
      continue;
    }
    std::rotate(face.begin(), std::min_element(face.begin(), end), end);
    split.tets[static_cast<std::size_t>(split.count++)] = {lowest, face[0], face[1], face[2]};
    if (corners == 4) {
      split.tets[static_cast<std::size_t>(split.count++)] = {lowest, face[0], face[2], face[3]};
    }
  }
  return split;
}

MeshView::MeshView(const Mesh& mesh, const LabelImage& image)
    : mesh_(&mesh),
      first_{0, mesh.tets.size(), mesh.tets.size() + mesh.pyramids.size(),
             mesh.tets.size() + mesh.pyramids.size() + mesh.wedges.size()},
      local_points_(mesh.points.size()),
      labels_(labels_of(mesh)) {
  require_sound(mesh);
#pragma omp parallel for
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    local_points_[v] = image.frame.to_local(mesh.points[v]);
  }
  cell_label_.resize(mesh.cell_count());
  const auto index_labels = [this](const std::vector<Label>& labels, std::size_t first) {
#pragma omp parallel for
    for (std::size_t c = 0; c < labels.size(); ++c) {
      const auto found = std::lower_bound(labels_.begin(), labels_.end(), labels[c]);
      cell_label_[first + c] = static_cast<std::uint32_t>(found - labels_.begin());
    }
  };
  index_labels(mesh.tets.labels, first_[0]);
  index_labels(mesh.pyramids.labels, first_[1]);
  index_labels(mesh.wedges.labels, first_[2]);
  index_labels(mesh.hexes.labels, first_[3]);
}

CellView MeshView::cell(std::size_t cell) const {
  if (cell < first_[1]) {
    return {CellKind::kTet, mesh_->tets.nodes[cell]};
  }
  if (cell < first_[2]) {
    return {CellKind::kPyramid, mesh_->pyramids.nodes[cell - first_[1]]};
  }
  if (cell < first_[3]) {
    return {CellKind::kWedge, mesh_->wedges.nodes[cell - first_[2]]};
  }
  return {CellKind::kHex, mesh_->hexes.nodes[cell - first_[3]]};
}

std::optional<std::uint32_t> MeshView::find_label(Label label) const {
  const auto found = std::lower_bound(labels_.begin(), labels_.end(), label);
  if (found == labels_.end() || *found != label) {
    return std::nullopt;
  }
  return static_cast<std::uint32_t>(found - labels_.begin());
}

}  // namespace cbc3d::metrics
