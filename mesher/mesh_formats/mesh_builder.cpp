#include "mesher/mesh_formats/mesh_builder.hpp"

#include <limits>
#include <utility>

namespace cbc3d {

void MeshBuilder::add_node(std::int64_t number, const Vec3& at) {
  const std::size_t count = mesh_.points.size();
  if (count >= std::numeric_limits<VertexId>::max()) fail_("it has more nodes than can be numbered");
  if (count == 0) first_ = number;
  if (in_turn_ && number != first_ + static_cast<std::int64_t>(count)) {
    in_turn_ = false;
    for (std::size_t v = 0; v < count; ++v) {
      numbers_.emplace(first_ + static_cast<std::int64_t>(v), static_cast<VertexId>(v));
    }
  }
  if (!in_turn_ && !numbers_.emplace(number, static_cast<VertexId>(count)).second) {
    fail_("it has the node " + std::to_string(number) + " twice; export it again");
  }
  mesh_.points.push_back(at);
}

VertexId MeshBuilder::vertex_of(std::int64_t number) const {
  if (in_turn_) {
    const auto offset = static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(first_);
    if (offset < mesh_.points.size()) return static_cast<VertexId>(offset);
  } else if (const auto found = numbers_.find(number); found != numbers_.end()) {
    return found->second;
  }
  fail_("an element names the node " + std::to_string(number) + ", which is not there; export it again");
  return kNoVertex;
}

template <int Nodes>
void MeshBuilder::add_to(CellBlock<Nodes>& block, std::span<const std::int64_t> numbers, Label label) {
  std::array<VertexId, Nodes> cell{};
  if (numbers.size() != Nodes) {
    fail_("an element has " + std::to_string(numbers.size()) + " nodes, not " + std::to_string(Nodes) +
          "; the file is damaged, export it again");
  }
  for (std::size_t n = 0; n < Nodes; ++n) cell[n] = vertex_of(numbers[n]);
  block.add(cell, label);
}

void MeshBuilder::add_cell(CellKind kind, std::span<const std::int64_t> numbers, Label label) {
  switch (kind) {
    case CellKind::tet:
      return add_to(mesh_.tets, numbers, label);
    case CellKind::pyramid:
      return add_to(mesh_.pyramids, numbers, label);
    case CellKind::wedge:
      return add_to(mesh_.wedges, numbers, label);
    case CellKind::hex:
      return add_to(mesh_.hexes, numbers, label);
  }
}

Mesh MeshBuilder::take() {
  if (mesh_.cell_count() == 0) fail_("it has no tets, pyramids, wedges or hexes; give a volume mesh");
  return std::move(mesh_);
}

}  // namespace cbc3d
