#include "mesher/mesh_formats/labelled_interfaces.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

/// A facet of a cell in the list of its smallest node. Three smallest nodes distinguish the facets of a
/// conforming mesh.
struct Entry {
  VertexId second, third;
  CellFacet facet;
  Label label;

  [[nodiscard]] bool same_nodes(const Entry& other) const {
    return second == other.second && third == other.third;
  }
};

std::array<VertexId, 3> smallest_nodes(std::span<const VertexId> cell, const FacetCorners& facet) {
  std::array<VertexId, 4> nodes{kNoVertex, kNoVertex, kNoVertex, kNoVertex};
  for (std::size_t n = 0; n < 4 && facet[n] != kNoCorner; ++n) nodes[n] = cell[facet[n]];
  std::sort(nodes.begin(), nodes.end());
  return {nodes[0], nodes[1], nodes[2]};
}

template <typename Visit>
void for_each_facet(const std::vector<FileCells>& blocks, const Visit& visit) {
  std::uint32_t number = 0;
  for (const FileCells& block : blocks) {
    const CellKindRow& row = row_of(block.kind);
    for (std::size_t c = 0; c < block.size(); ++c, ++number) {
      for (std::uint8_t f = 0; f < row.facets; ++f) {
        visit(smallest_nodes(block.nodes_of(c), row.facet[f]), CellFacet{number, f}, block.labels[c]);
      }
    }
  }
}

/// The facets of all cells, those of one smallest node together.
struct FacetLists {
  std::vector<Entry> entries;
  std::vector<std::size_t> begin;

  FacetLists(const std::vector<FileCells>& blocks, std::size_t points) : begin(points + 2, 0) {
    for_each_facet(blocks, [&](const auto& nodes, CellFacet, Label) { ++begin[nodes[0] + 2]; });
    for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
    entries.resize(begin.back());
    for_each_facet(blocks, [&](const auto& nodes, CellFacet facet, Label label) {
      entries[begin[nodes[0] + 1]++] = {nodes[1], nodes[2], facet, label};
    });
  }

  [[nodiscard]] std::span<Entry> of(std::size_t vertex) {
    return {entries.data() + begin[vertex], begin[vertex + 1] - begin[vertex]};
  }
};

/// Interfaces under construction; the outside stands behind every label.
class InterfaceTable {
 public:
  void add_outer(const Entry& entry) { at(entry.label, std::nullopt).facets.push_back(entry.facet); }
  void add_pair(const Entry& a, const Entry& b) {
    const auto& [lower, higher] = a.label < b.label ? std::tie(a, b) : std::tie(b, a);
    Interface& interface = at(lower.label, higher.label);
    interface.facets.push_back(lower.facet);
    interface.opposite.push_back(higher.facet);
  }
  std::vector<Interface> take() {
    std::vector<Interface> all;
    all.reserve(table_.size());
    for (auto& [key, interface] : table_) all.push_back(std::move(interface));
    return all;
  }

 private:
  Interface& at(Label label, std::optional<Label> other) {
    const std::pair<Label, std::int64_t> key{label, other ? *other : std::int64_t{1} << 40U};
    Interface& interface = table_[key];
    interface.label = label;
    interface.other = other;
    return interface;
  }
  std::map<std::pair<Label, std::int64_t>, Interface> table_;
};

void take_facets(std::span<Entry> facets, InterfaceTable& table) {
  std::sort(facets.begin(), facets.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.second, a.third, a.facet.cell) < std::tie(b.second, b.third, b.facet.cell);
  });
  for (std::size_t f = 0; f < facets.size();) {
    std::size_t end = f + 1;
    while (end < facets.size() && facets[end].same_nodes(facets[f])) ++end;
    if (end - f > 2) {
      throw InputError(
          "a facet belongs to " + std::to_string(end - f) +
          " cells, so that there are no interfaces; repair the mesh or write .vtu, which has none");
    }
    if (end - f == 1) {
      table.add_outer(facets[f]);
    } else if (facets[f].label != facets[f + 1].label) {
      table.add_pair(facets[f], facets[f + 1]);
    }
    f = end;
  }
}

}  // namespace

std::vector<Interface> labelled_interfaces(const std::vector<FileCells>& blocks, std::size_t points) {
  FacetLists lists(blocks, points);
  InterfaceTable table;
  for (std::size_t v = 0; v < points; ++v) take_facets(lists.of(v), table);
  return table.take();
}

}  // namespace cbc3d
