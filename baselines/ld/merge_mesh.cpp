#include "baselines/ld/merge_mesh.hpp"

#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::ld {

MergeMesh::MergeMesh(LatticeMesh mesh) : mesh_(std::move(mesh)) {
  if (mesh_.tets.size() > kEnd / 4) {
    throw JobError("a part of the mesh has " + std::to_string(mesh_.tets.size()) +
                   " tets, more than can be numbered; give larger bounds");
  }
  first_.assign(mesh_.points.size(), kEnd);
  next_.resize(4 * mesh_.tets.size());
  for (std::size_t corner = next_.size(); corner-- > 0;) {
    std::uint32_t& first = first_[mesh_.tets[corner / 4][corner % 4]];
    next_[corner] = first;
    first = static_cast<std::uint32_t>(corner);
  }
}

void MergeMesh::merge(VertexId v, VertexId w) {
  std::uint32_t last = kEnd;
  for_star(v, [&](TetId t, std::uint32_t node) {
    auto& nodes = mesh_.tets[t];
    bool has_both = false;
    for (const VertexId other : nodes) has_both = has_both || other == w;
    if (has_both) {
      nodes[0] = kNoVertex;
    } else {
      nodes[node] = w;
    }
    last = 4 * t + node;
  });
  if (last != kEnd) {
    next_[last] = first_[w];
    first_[w] = first_[v];
  }
  first_[v] = kEnd;
}

LatticeMesh MergeMesh::release() {
  std::vector<VertexId> ids(mesh_.points.size(), kNoVertex);
  for (const auto& nodes : mesh_.tets) {
    for (const VertexId v : nodes) {
      if (nodes[0] != kNoVertex) ids[v] = 0;
    }
  }
  LatticeMesh left;
  for (std::size_t v = 0; v < ids.size(); ++v) {
    if (ids[v] == kNoVertex) continue;
    ids[v] = static_cast<VertexId>(left.points.size());
    left.points.push_back(mesh_.points[v]);
    left.states.push_back(mesh_.states[v]);
  }
  for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
    auto nodes = mesh_.tets[t];
    if (nodes[0] == kNoVertex) continue;
    for (VertexId& v : nodes) v = ids[v];
    left.tets.push_back(nodes);
    left.materials.push_back(mesh_.materials[t]);
  }
  left.pieces = std::move(mesh_.pieces);
  for (BoundaryPiece& piece : left.pieces) {
    for (VertexId& v : piece.facet) v = ids[v];
  }
  return left;
}

}  // namespace cbc3d::baselines::ld
