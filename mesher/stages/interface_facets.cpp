#include "mesher/stages/interface_facets.hpp"

#include <algorithm>
#include <atomic>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr std::uint8_t kNone = 255;

/// Facets of one kind of cell, nodes counter-clockwise seen from outside; a triangle's fourth is kNone.
struct CellFacets {
  unsigned count;
  std::array<std::array<std::uint8_t, 4>, 6> nodes;
};

constexpr CellFacets kTetFacets = {
    4, {{{1, 2, 3, kNone}, {0, 3, 2, kNone}, {0, 1, 3, kNone}, {0, 2, 1, kNone}}}};
constexpr CellFacets kPyramidFacets = {
    5, {{{0, 3, 2, 1}, {0, 1, 4, kNone}, {1, 2, 4, kNone}, {2, 3, 4, kNone}, {3, 0, 4, kNone}}}};
constexpr CellFacets kHexFacets = {
    6, {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};

const CellFacets& facets_of(std::size_t node_count) {
  return node_count == 4 ? kTetFacets : node_count == 5 ? kPyramidFacets : kHexFacets;
}

/// A facet of one of the cells at its smallest node. `key`: its second and third smallest node, which with
/// the smallest tell it from every other facet of a conforming mesh.
struct Facet {
  std::uint64_t key;
  CellId cell;
  std::uint8_t number;  ///< among the cell's facets
};

/// The key of a facet; 0 when v is not its smallest node.
std::uint64_t key_of(std::span<const VertexId> cell, const std::array<std::uint8_t, 4>& facet, VertexId v) {
  bool touches = false;
  VertexId second = kNoVertex;
  VertexId third = kNoVertex;
  for (std::size_t n = 0; n < 4 && facet[n] != kNone; ++n) {
    const VertexId node = cell[facet[n]];
    if (node < v) {
      return 0;
    }
    if (node == v) {
      touches = true;
    } else if (node < second) {
      third = second;
      second = node;
    } else if (node < third) {
      third = node;
    }
  }
  return touches ? std::uint64_t{second} << 32U | third : 0;
}

/// The facets whose smallest node is v, sorted by their nodes.
void collect_facets(const MaterialMesh& mesh, std::span<const CellId> cells, VertexId v,
                    std::vector<Facet>& facets) {
  facets.clear();
  for (const CellId c : cells) {
    const auto nodes = mesh.nodes_of(c);
    const CellFacets& kind = facets_of(nodes.size());
    for (unsigned f = 0; f < kind.count; ++f) {
      if (const std::uint64_t key = key_of(nodes, kind.nodes[f], v)) {
        facets.push_back({key, c, static_cast<std::uint8_t>(f)});
      }
    }
  }
  std::sort(facets.begin(), facets.end(),
            [](const Facet& a, const Facet& b) { return a.key != b.key ? a.key < b.key : a.cell < b.cell; });
}

/// A facet of a cell of `inside` with `across` on its other side, turned from the lower material to the
/// higher.
InterfaceFacet turned(const MaterialMesh& mesh, const Facet& facet, MaterialId inside, MaterialId across) {
  const auto cell = mesh.nodes_of(facet.cell);
  const auto& local = facets_of(cell.size()).nodes[facet.number];
  InterfaceFacet out{};
  for (std::size_t n = 0; n < 4; ++n) {
    out.nodes[n] = local[n] == kNone ? kNoVertex : cell[local[n]];
  }
  out.lower = std::min(inside, across);
  out.higher = std::max(inside, across);
  if (inside > across) {
    std::swap(out.nodes[0], out.nodes[2]);  // reverses triangles and quadrilaterals alike
  }
  return out;
}

/// Keeps of sorted facets those that part two materials. False when a facet occurs more than twice.
bool keep_interfaces(const MaterialMesh& mesh, const std::vector<Facet>& facets,
                     std::vector<InterfaceFacet>& kept) {
  for (std::size_t f = 0; f < facets.size();) {
    std::size_t next = f + 1;
    while (next < facets.size() && facets[next].key == facets[f].key) {
      ++next;
    }
    const MaterialId inside = mesh.material_of(facets[f].cell);
    const MaterialId across = next - f == 1 ? kBackground : mesh.material_of(facets[f + 1].cell);
    if (next - f > 2) {
      return false;
    }
    if (inside != across) {
      kept.push_back(turned(mesh, facets[f], inside, across));
    }
    f = next;
  }
  return true;
}

}  // namespace

std::vector<InterfaceFacet> interface_facets(const MaterialMesh& mesh, const VertexCells& around) {
  constexpr std::size_t kChunk = 4096;
  const std::size_t count = mesh.points.size();
  std::vector<std::vector<InterfaceFacet>> chunks((count + kChunk - 1) / kChunk);
  std::atomic<bool> conforming = true;
#pragma omp parallel
  {
    std::vector<Facet> facets;
#pragma omp for schedule(dynamic, 1)
    for (std::size_t c = 0; c < chunks.size(); ++c) {
      for (std::size_t v = c * kChunk; v < std::min(count, (c + 1) * kChunk); ++v) {
        const auto vertex = static_cast<VertexId>(v);
        collect_facets(mesh, around.of(vertex), vertex, facets);
        if (!keep_interfaces(mesh, facets, chunks[c])) {
          conforming = false;
        }
      }
    }
  }
  if (!conforming) {
    throw JobError("the mesh is not conforming: a facet belongs to more than two cells");
  }
  std::vector<InterfaceFacet> all;
  for (const auto& chunk : chunks) {
    all.insert(all.end(), chunk.begin(), chunk.end());
  }
  return all;
}

}  // namespace cbc3d
