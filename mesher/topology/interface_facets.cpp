#include "mesher/topology/interface_facets.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

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

constexpr CellId kNoCell = ~CellId{0};

/// A facet at its smallest node. `key`: its second and third smallest node, which with the smallest
/// distinguish it from every other facet of a conforming mesh.
struct Facet {
  std::uint64_t key;
  CellId cell;
  CellId across;        ///< kNoCell for one on the mesh's surface
  std::uint8_t number;  ///< among the facets of `cell`
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

/// The key of the facet of a tet opposite node f, whose smallest node is node `own`.
std::uint64_t key_of_tet_facet(const std::array<VertexId, 4>& tet, unsigned own, unsigned f) {
  const unsigned others = 15U & ~(1U << own | 1U << f);
  const VertexId a = tet[static_cast<unsigned>(std::countr_zero(others))];
  const VertexId b = tet[static_cast<unsigned>(std::bit_width(others)) - 1];
  return a < b ? std::uint64_t{a} << 32U | b : std::uint64_t{b} << 32U | a;
}

/// Adds a cell's facet, or the cell to the facet that is there. False when that has two cells already.
bool add_facet(std::uint64_t key, CellId cell, std::size_t number, std::vector<Facet>& facets) {
  // A vertex has a dozen: a search is quicker than any order.
  const auto same =
      std::find_if(facets.begin(), facets.end(), [&](const Facet& facet) { return facet.key == key; });
  if (same == facets.end()) {
    facets.push_back({key, cell, kNoCell, static_cast<std::uint8_t>(number)});
    return true;
  }
  const bool is_second = same->across == kNoCell;
  same->across = cell;
  return is_second;
}

/// Adds the facets of a tet whose smallest node is v: the three at v where v is the smallest of the tet's
/// nodes, the one opposite the smaller node where one is. Most tets around a vertex have none.
bool add_facets_of_tet(const std::array<VertexId, 4>& tet, CellId cell, VertexId v,
                       std::vector<Facet>& facets) {
  unsigned smaller = 0;
  unsigned own = 0;
  for (unsigned n = 0; n < 4; ++n) {
    smaller |= tet[n] < v ? 1U << n : 0U;
    own = tet[n] == v ? n : own;
  }
  unsigned opposite = smaller == 0 ? 15U & ~(1U << own) : std::has_single_bit(smaller) ? smaller : 0;
  bool conforming = true;
  for (; opposite != 0; opposite &= opposite - 1) {
    const auto f = static_cast<unsigned>(std::countr_zero(opposite));
    conforming &= add_facet(key_of_tet_facet(tet, own, f), cell, f, facets);
  }
  return conforming;
}

/// The facets whose smallest node is v. False when one belongs to more than two cells.
bool collect_facets(const MaterialMesh& mesh, std::span<const CellId> cells, VertexId v,
                    std::vector<Facet>& facets) {
  facets.clear();
  bool conforming = true;
  for (const CellId c : cells) {
    if (c < mesh.tets.size()) {
      conforming &= add_facets_of_tet(mesh.tets[c], c, v, facets);
      continue;
    }
    const auto nodes = mesh.nodes_of(c);
    const CellFacets& kind = facets_of(nodes.size());
    for (std::size_t f = 0; f < kind.count; ++f) {
      if (const std::uint64_t key = key_of(nodes, kind.nodes[f], v)) {
        conforming &= add_facet(key, c, f, facets);
      }
    }
  }
  return conforming;
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

/// Keeps of a vertex's facets those that part two materials, ordered by their nodes.
void keep_interfaces(const MaterialMesh& mesh, std::vector<Facet>& facets,
                     std::vector<InterfaceFacet>& kept) {
  const auto across_of = [&](const Facet& facet) {
    return facet.across == kNoCell ? kBackground : mesh.material_of(facet.across);
  };
  std::erase_if(facets, [&](const Facet& f) { return mesh.material_of(f.cell) == across_of(f); });
  std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.key < b.key; });
  for (const Facet& facet : facets) {
    kept.push_back(turned(mesh, facet, mesh.material_of(facet.cell), across_of(facet)));
  }
}

}  // namespace

std::vector<InterfaceFacet> interface_facets(const MaterialMesh& mesh, const VertexCells& around) {
  constexpr std::size_t kChunk = 512;
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
        if (!collect_facets(mesh, around.of(vertex), vertex, facets)) {
          conforming = false;
        }
        keep_interfaces(mesh, facets, chunks[c]);
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
