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

/// A facet seen from one of its cells; `key` are its nodes ascending, kNoVertex last for a triangle.
struct Facet {
  std::array<VertexId, 4> key;
  std::array<VertexId, 4> nodes;
  MaterialId material;
};

/// The facets whose smallest node is v, sorted by their nodes.
void collect_facets(const MaterialMesh& mesh, std::span<const CellId> cells, VertexId v,
                    std::vector<Facet>& facets) {
  facets.clear();
  for (const CellId c : cells) {
    const auto nodes = mesh.nodes_of(c);
    const CellFacets& kind = facets_of(nodes.size());
    for (unsigned f = 0; f < kind.count; ++f) {
      Facet facet{};
      bool touches = false;
      bool smallest = true;
      for (std::size_t n = 0; n < 4; ++n) {
        const std::uint8_t local = kind.nodes[f][n];
        facet.nodes[n] = local == kNone ? kNoVertex : nodes[local];
        touches |= facet.nodes[n] == v;
        smallest &= facet.nodes[n] >= v;
      }
      if (touches && smallest) {
        facet.key = facet.nodes;
        std::sort(facet.key.begin(), facet.key.end());
        facet.material = mesh.material_of(c);
        facets.push_back(facet);
      }
    }
  }
  std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.key < b.key; });
}

/// A facet of a cell of `inside` with `across` on its other side, turned from the lower material to the
/// higher.
InterfaceFacet turned(const Facet& facet, MaterialId inside, MaterialId across) {
  InterfaceFacet out = {facet.nodes, std::min(inside, across), std::max(inside, across)};
  if (inside > across) {
    std::swap(out.nodes[0], out.nodes[2]);  // reverses triangles and quadrilaterals alike
  }
  return out;
}

/// Keeps of sorted facets those that part two materials. False when a facet occurs more than twice.
bool keep_interfaces(const std::vector<Facet>& facets, std::vector<InterfaceFacet>& kept) {
  for (std::size_t f = 0; f < facets.size();) {
    std::size_t next = f + 1;
    while (next < facets.size() && facets[next].key == facets[f].key) {
      ++next;
    }
    const MaterialId inside = facets[f].material;
    const MaterialId across = next - f == 1 ? kBackground : facets[f + 1].material;
    if (next - f > 2) {
      return false;
    }
    if (inside != across) {
      kept.push_back(turned(facets[f], inside, across));
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
        if (!keep_interfaces(facets, chunks[c])) {
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
