#include "mesher/improve/surface/labelled_complex.hpp"

namespace cbc3d {

void LabelledComplex::renew_set(VertexId v) {
  MaterialSet& set = sets_[v];
  set = {};
  for (const TetId t : star(v)) {
    set.add(mesh_.materials[t]);
    for (std::size_t n = 0; n < 4; ++n) {
      if (mesh_.tets[t][n] != v && neighbours_[t][n] == kNoTet) {
        set.add(kBackground);
      }
    }
  }
}

bool LabelledComplex::is_facet(TetId t, std::size_t n) const {
  const MaterialId own = material(t);
  const MaterialId other = across(t, n);
  if (own == kBackground || other == kBackground) {
    return own != kBackground;
  }
  const auto& nodes = mesh_.tets[t];
  return t < neighbours_[t][n] && label_of_[own] != label_of_[other] &&
         std::any_of(kTetFace[n].begin(), kTetFace[n].end(),
                     [&](std::uint8_t i) { return sets_[nodes[i]].has(kBackground); });
}

bool LabelledComplex::is_manifold_at(VertexId v, MaterialId material) const {
  const MaterialId label = label_of_[material];
  LinkEdges link;
  for (const TetId t : star(v)) {
    for (std::size_t n = 0; label_of_[mesh_.materials[t]] == label && n < 4; ++n) {
      if (mesh_.tets[t][n] != v && label_of_[across(t, n)] != label) {
        add_link_edge(t, n, v, link);
      }
    }
  }
  if (material == kBackground) {
    add_open_faces(v, link);
  }
  return link.empty() || is_one_cycle(link);
}

void LabelledComplex::add_link_edge(TetId t, std::size_t n, VertexId v, LinkEdges& link) const {
  std::array<VertexId, 2> edge{};
  std::size_t count = 0;
  for (const std::uint8_t corner : kTetFace[n]) {
    if (mesh_.tets[t][corner] != v) {
      edge[count++] = mesh_.tets[t][corner];
    }
  }
  link.push_back(edge);
}

void LabelledComplex::add_open_faces(VertexId v, LinkEdges& link) const {
  for (const TetId t : star(v)) {
    for (std::size_t n = 0; mesh_.materials[t] != kBackground && n < 4; ++n) {
      if (mesh_.tets[t][n] != v && neighbours_[t][n] == kNoTet) {
        add_link_edge(t, n, v, link);
      }
    }
  }
}

bool LabelledComplex::is_one_cycle(const LinkEdges& link) {
  const VertexId first = link[0][0];
  VertexId at = link[0][1];
  std::size_t used = 0;
  for (std::size_t steps = 1; steps <= link.size(); ++steps) {
    std::size_t degree = 0;
    std::size_t next = used;
    for (std::size_t e = 0; e < link.size(); ++e) {
      if (link[e][0] == at || link[e][1] == at) {
        ++degree;
        next = e == used ? next : e;
      }
    }
    if (degree != 2) {
      return false;
    }
    if (at == first) {
      return steps == link.size();
    }
    used = next;
    at = link[next][0] == at ? link[next][1] : link[next][0];
  }
  return false;
}

void remove_background(MaterialMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.materials[t] != kBackground) {
      mesh.tets[kept] = mesh.tets[t];
      mesh.materials[kept++] = mesh.materials[t];
    }
  }
  mesh.tets.resize(kept);
  mesh.materials.resize(kept);
}

}  // namespace cbc3d
