#include "mesher/improve/surface/topology_guard.hpp"

#include <algorithm>

namespace cbc3d {
namespace {

template <typename T>
void make_unique(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

TopologyGuard::TopologyGuard(const LabelledComplex& complex, const std::vector<TetId>& tets,
                             std::vector<MaterialId> materials)
    : complex_(complex) {
  std::erase(materials, kBackground);
  make_unique(materials);
  if (materials.empty()) {
    return;
  }
  collect_cells(tets);
  for (const MaterialId material : materials) {
    if (std::all_of(vertices_.begin(), vertices_.end(),
                    [&](VertexId v) { return complex.is_manifold_at(v, material); })) {
      guard(material, false);
      guard(material, true);
    }
  }
}

bool TopologyGuard::holds() const {
  return std::all_of(guarded_.begin(), guarded_.end(),
                     [this](const Guarded& what) { return characteristic(what) == what.characteristic; });
}

void TopologyGuard::collect_cells(const std::vector<TetId>& tets) {
  tets_ = tets;
  make_unique(tets_);
  for (const TetId t : tets_) {
    const auto& nodes = complex_.mesh().tets[t];
    for (std::size_t n = 0; n < 4; ++n) {
      vertices_.push_back(nodes[n]);
      for (std::size_t m = n + 1; m < 4; ++m) {
        edges_.push_back({std::min(nodes[n], nodes[m]), std::max(nodes[n], nodes[m])});
      }
      const TetId across = complex_.neighbour(t, n);
      faces_.push_back({std::min(t, across), std::max(t, across)});
    }
  }
  make_unique(vertices_);
  make_unique(edges_);
  std::sort(faces_.begin(), faces_.end());
  // Two tets share one face, but a tet may have several on the outside.
  const auto is_again = [](const auto& a, const auto& b) { return a == b && a[1] != kNoTet; };
  faces_.erase(std::unique(faces_.begin(), faces_.end(), is_again), faces_.end());
}

void TopologyGuard::guard(MaterialId material, bool as_label) {
  Guarded what{material, as_label, 0};
  what.characteristic = characteristic(what);
  guarded_.push_back(what);
}

bool TopologyGuard::has(TetId t, const Guarded& what) const {
  return t != kNoTet &&
         (what.as_label ? complex_.has_label_of(t, what.material) : complex_.material(t) == what.material);
}

bool TopologyGuard::has_edge(const std::array<VertexId, 2>& edge, const Guarded& what) const {
  const auto star = complex_.star(edge[0]);
  return std::any_of(star.begin(), star.end(), [&](TetId t) {
    const auto& nodes = complex_.mesh().tets[t];
    return std::find(nodes.begin(), nodes.end(), edge[1]) != nodes.end() && has(t, what);
  });
}

int TopologyGuard::characteristic(const Guarded& what) const {
  const auto vertices = std::count_if(vertices_.begin(), vertices_.end(), [&](VertexId v) {
    const auto star = complex_.star(v);
    return std::any_of(star.begin(), star.end(), [&](TetId t) { return has(t, what); });
  });
  const auto edges =
      std::count_if(edges_.begin(), edges_.end(), [&](const auto& edge) { return has_edge(edge, what); });
  const auto faces = std::count_if(faces_.begin(), faces_.end(), [&](const auto& sides) {
    return has(sides[0], what) || has(sides[1], what);
  });
  const auto tets = std::count_if(tets_.begin(), tets_.end(), [&](TetId t) { return has(t, what); });
  return static_cast<int>(vertices - edges + faces - tets);
}

}  // namespace cbc3d
