#include "baselines/cleaver/cut_lattice.hpp"

#include <algorithm>
#include <tuple>

#include "mesher/core/parallel.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// An edge of a mixed tet, so that the tets of an edge stand together when sorted.
struct EdgeUse {
  VertexId first, second;
  std::uint32_t mixed;
  std::uint32_t edge;

  bool operator<(const EdgeUse& o) const {
    return std::tie(first, second, mixed) < std::tie(o.first, o.second, o.mixed);
  }
};

std::vector<MixedTet> mixed_tets(const CutLattice& cut) {
  const auto& tets = cut.lattice.tets;
  const std::vector<std::uint32_t> found = indices_where(tets.size(), [&](std::size_t t) {
    const auto& m = cut.materials;
    const auto& n = tets[t];
    return m[n[0]] != m[n[1]] || m[n[0]] != m[n[2]] || m[n[0]] != m[n[3]];
  });
  std::vector<MixedTet> mixed(found.size());
  for (std::size_t t = 0; t < found.size(); ++t) {
    mixed[t].tet = found[t];
    mixed[t].cuts.fill(kNone);
    mixed[t].triples.fill(kNone);
  }
  return mixed;
}

std::vector<EdgeUse> cut_edge_uses(const CutLattice& cut) {
  std::vector<EdgeUse> uses = collect<EdgeUse>(cut.mixed.size(), 6, [&](std::size_t t, const auto& add) {
    const auto& nodes = cut.lattice.tets[cut.mixed[t].tet];
    for (std::uint32_t e = 0; e < 6; ++e) {
      const VertexId a = nodes[kTetEdge[e][0]], b = nodes[kTetEdge[e][1]];
      if (cut.materials[a] == cut.materials[b]) continue;
      add(EdgeUse{std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), e});
    }
  });
  sort_distinct(uses);
  return uses;
}

void number_cuts(CutLattice& cut) {
  const std::vector<EdgeUse> uses = cut_edge_uses(cut);
  for (const EdgeUse& use : uses) {
    const bool is_new =
        cut.cuts.empty() || cut.cuts.back().first != use.first || cut.cuts.back().second != use.second;
    if (is_new) {
      Cut edge{};
      edge.first = use.first;
      edge.second = use.second;
      cut.cuts.push_back(edge);
    }
    cut.mixed[use.mixed].cuts[use.edge] = static_cast<std::uint32_t>(cut.cuts.size() - 1);
  }
}

}  // namespace

CutLattice cut_edges(Lattice lattice, std::vector<MaterialId> materials, const Indicators& indicators) {
  CutLattice cut;
  cut.lattice = std::move(lattice);
  cut.materials = std::move(materials);
  cut.mixed = mixed_tets(cut);
  number_cuts(cut);
#pragma omp parallel for schedule(dynamic, 512)
  for (std::size_t c = 0; c < cut.cuts.size(); ++c) {
    Cut& edge = cut.cuts[c];
    edge.fraction = static_cast<float>(
        indicators.crossing(cut.lattice.points[edge.first], cut.lattice.points[edge.second],
                            cut.materials[edge.first], cut.materials[edge.second]));
  }
  return cut;
}

}  // namespace cbc3d::baselines::cleaver
