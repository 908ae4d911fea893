// A mesh from a file whose nodes have numbers of any kind.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/cell_kinds.hpp"

namespace cbc3d {

class MeshBuilder {
 public:
  using Fail = std::function<void(const std::string&)>;
  /// `fail` throws InputError with a place in the file.
  explicit MeshBuilder(Fail fail) : fail_(std::move(fail)) {}

  /// Fails for a number that is there already.
  void add_node(std::int64_t number, const Vec3& at);
  [[nodiscard]] bool has_nodes() const { return !mesh_.points.empty(); }
  [[nodiscard]] std::size_t node_count() const { return mesh_.points.size(); }
  /// A cell by the numbers of its nodes; fails where one is not there.
  void add_cell(CellKind kind, std::span<const std::int64_t> numbers, Label label);
  /// The mesh; fails where it has no cells.
  Mesh take();

 private:
  template <int Nodes>
  void add_to(CellBlock<Nodes>& block, std::span<const std::int64_t> numbers, Label label);
  [[nodiscard]] VertexId vertex_of(std::int64_t number) const;

  Fail fail_;
  Mesh mesh_;
  // Nodes are mostly numbered in turn; the others are looked up.
  std::int64_t first_ = 0;
  bool in_turn_ = true;
  std::unordered_map<std::int64_t, VertexId> numbers_;
};

}  // namespace cbc3d
