#include "mesher/improve/local/tet_complex.hpp"

#include <algorithm>

#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {
namespace {

std::array<VertexId, 3> face_key(const std::array<VertexId, 4>& nodes, unsigned opposite) {
  std::array<VertexId, 3> key = {nodes[kTetFace[opposite][0]], nodes[kTetFace[opposite][1]],
                                 nodes[kTetFace[opposite][2]]};
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

TetComplex::TetComplex(std::vector<Vec3> points, TetNodes tets, std::vector<MaterialId> materials,
                       std::vector<std::uint8_t> hold)
    : points_(std::move(points)),
      tets_(std::move(tets)),
      materials_(std::move(materials)),
      across_(tet_neighbours(tets_, points_.size())),
      tet_at_(points_.size(), kNoTet),
      hold_(std::move(hold)),
      seen_(tets_.size(), 0) {
  for (TetId t = 0; t < tets_.size(); ++t) {
    for (const VertexId v : tets_[t]) {
      tet_at_[v] = t;
    }
  }
}

double TetComplex::quality(TetId t) const {
  const auto& n = tets_[t];
  return tet_quality(points_[n[0]], points_[n[1]], points_[n[2]], points_[n[3]]);
}

template <typename Ends>
TetId TetComplex::walk_star(VertexId v, std::vector<TetId>& tets, const Ends& ends) const {
  tets.clear();
  if (++stamp_ == 0) {
    std::fill(seen_.begin(), seen_.end(), 0);
    stamp_ = 1;
  }
  tets.push_back(tet_at_[v]);
  seen_[tet_at_[v]] = stamp_;
  for (std::size_t i = 0; i < tets.size(); ++i) {
    const TetId t = tets[i];
    if (ends(t)) {
      return t;
    }
    const auto& nodes = tets_[t];
    const auto& across = across_[t];
    for (unsigned n = 0; n < 4; ++n) {
      const TetId next = across[n];
      if (nodes[n] != v && next != kNoTet && seen_[next] != stamp_) {
        seen_[next] = stamp_;
        tets.push_back(next);
      }
    }
  }
  return kNoTet;
}

void TetComplex::star(VertexId v, std::vector<TetId>& tets) const {
  walk_star(v, tets, [](TetId) { return false; });
}

void TetComplex::neighbours(VertexId v, std::span<const TetId> star, std::vector<VertexId>& vertices) const {
  vertices.clear();
  for (const TetId t : star) {
    for (const VertexId w : tets_[t]) {
      if (w != v && std::find(vertices.begin(), vertices.end(), w) == vertices.end()) {
        vertices.push_back(w);
      }
    }
  }
}

MaterialSet TetComplex::materials(VertexId v, std::span<const TetId> star) const {
  MaterialSet set;
  for (const TetId t : star) {
    set.add(materials_[t]);
    for (unsigned n = 0; n < 4; ++n) {
      if (across_[t][n] == kNoTet && tets_[t][n] != v) {
        set.add(kBackground);
      }
    }
  }
  return set;
}

void TetComplex::facets(VertexId v, std::span<const TetId> star, std::vector<FacetAt>& facets) const {
  facets.clear();
  for (const TetId t : star) {
    const auto& nodes = tets_[t];
    for (unsigned n = 0; n < 4; ++n) {
      if (nodes[n] == v) {
        continue;
      }
      const MaterialId other = material_across(t, n);
      if (materials_[t] > other) {
        const auto& face = kTetFace[n];
        const unsigned at = nodes[face[0]] == v ? 0 : nodes[face[1]] == v ? 1 : 2;
        facets.push_back({nodes[face[(at + 1) % 3]], nodes[face[(at + 2) % 3]], materials_[t], other});
      }
    }
  }
}

TetId TetComplex::across_ring(TetId t, VertexId a, VertexId b, VertexId keep) const {
  for (unsigned n = 0; n < 4; ++n) {
    const VertexId w = tets_[t][n];
    if (w != a && w != b && w != keep) {
      return across_[t][n];
    }
  }
  return kNoTet;
}

std::array<VertexId, 2> TetComplex::ring_ends(TetId t, VertexId a, VertexId b) const {
  std::array<VertexId, 2> ends{};
  std::size_t count = 0;
  for (const VertexId w : tets_[t]) {
    if (w != a && w != b) {
      ends[count++] = w;
    }
  }
  // Parity of (a, b, ends) against the tet's own order.
  const unsigned ia = node_index(t, a);
  const unsigned ib = node_index(t, b);
  if ((ia + ib - (ia < ib ? 1U : 0U)) % 2 == 1) {
    std::swap(ends[0], ends[1]);
  }
  return ends;
}

TetId TetComplex::first_of_ring(TetId found, VertexId a, VertexId b, bool& closed) const {
  for (TetId t = found;;) {
    const TetId back = across_ring(t, a, b, ring_ends(t, a, b)[0]);
    closed = back == found;
    if (closed) return found;
    if (back == kNoTet) return t;
    t = back;
  }
}

bool TetComplex::ring(VertexId a, VertexId b, EdgeRing& ring) const {
  ring.vertices.clear();
  ring.tets.clear();
  ring.closed = false;
  thread_local std::vector<TetId> around;
  const VertexId other = locked(a) ? a : b;
  const TetId found = walk_star(locked(a) ? b : a, around, [&](TetId t) { return has_node(t, other); });
  if (found == kNoTet) {
    return false;
  }
  const TetId first = first_of_ring(found, a, b, ring.closed);
  for (TetId t = first;;) {
    const auto ends = ring_ends(t, a, b);
    ring.vertices.push_back(ends[0]);
    ring.tets.push_back(t);
    const TetId next = across_ring(t, a, b, ends[1]);
    if (next == kNoTet) {
      ring.vertices.push_back(ends[1]);
    }
    if (next == kNoTet || next == first) {
      return true;
    }
    t = next;
  }
}

TetId TetComplex::take_slot() {
  if (!free_.empty()) {
    const TetId t = free_.back();
    free_.pop_back();
    return t;
  }
  tets_.emplace_back();
  materials_.push_back(kBackground);
  across_.push_back({kNoTet, kNoTet, kNoTet, kNoTet});
  seen_.push_back(0);
  return static_cast<TetId>(tets_.size() - 1);
}

void TetComplex::collect_faces(std::span<const TetId> old, std::span<const FreshTet> fresh) {
  faces_.clear();
  for (const TetId t : old) {
    for (unsigned n = 0; n < 4; ++n) {
      const TetId outer = across_[t][n];
      if (outer != kNoTet && std::find(old.begin(), old.end(), outer) == old.end()) {
        std::uint8_t back = 0;
        while (across_[outer][back] != t) {
          ++back;
        }
        faces_.push_back({face_key(tets_[t], n), outer, back, false});
      }
    }
  }
  for (TetId t = 0; t < fresh.size(); ++t) {
    for (std::uint8_t n = 0; n < 4; ++n) {
      faces_.push_back({face_key(fresh[t].nodes, n), t, n, true});
    }
  }
  std::sort(faces_.begin(), faces_.end(), [](const OpenFace& a, const OpenFace& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (a.key[i] != b.key[i]) {
        return a.key[i] < b.key[i];
      }
    }
    return a.fresh < b.fresh;
  });
}

bool TetComplex::is_elsewhere(const Face& face, std::span<const TetId> old) {
  const auto free =
      std::find_if(face.begin(), face.end(), [&](VertexId v) { return !locked(v) && in_use(v); });
  if (free == face.end()) {
    return false;
  }
  if (known_.vertex != *free) {
    star(*free, known_.tets);
    known_.vertex = *free;
  }
  return std::any_of(known_.tets.begin(), known_.tets.end(), [&](TetId t) {
    return has_node(t, face[0]) && has_node(t, face[1]) && has_node(t, face[2]) &&
           std::find(old.begin(), old.end(), t) == old.end();
  });
}

bool TetComplex::faces_fit(std::span<const TetId> old) {
  known_.vertex = kNoVertex;
  for (std::size_t i = 0; i < faces_.size();) {
    std::size_t same = 1;
    while (i + same < faces_.size() && faces_[i + same].same_key(faces_[i])) {
      ++same;
    }
    const bool fresh = faces_[i].fresh;  // those that were there come first
    if (same > 2 || (fresh && is_elsewhere(faces_[i].key, old))) {
      return false;
    }
    if (same == 2 && fresh && locked(faces_[i].key[0]) && locked(faces_[i].key[1]) &&
        locked(faces_[i].key[2])) {
      return false;  // another patch might make the same face
    }
    i += same;
  }
  return true;
}

void TetComplex::remove(std::span<const TetId> old) {
  for (const TetId t : old) {
    for (const VertexId v : tets_[t]) {
      tet_at_[v] = kNoTet;
    }
  }
  for (const OpenFace& face : faces_) {  // vertices of the old tets that still have others
    if (!face.fresh) {
      across_[face.tet][face.node] = kNoTet;
      for (const VertexId v : tets_[face.tet]) {
        if (tet_at_[v] == kNoTet) {
          tet_at_[v] = face.tet;
        }
      }
    }
  }
  for (const TetId t : old) {
    tets_[t].fill(kNoVertex);
    free_.push_back(t);
  }
}

bool TetComplex::replace(std::span<const TetId> old, std::span<const FreshTet> fresh) {
  collect_faces(old, fresh);
  if (!faces_fit(old)) {
    return false;
  }
  remove(old);
  placed_.clear();
  for (const FreshTet& tet : fresh) {
    const TetId t = take_slot();
    placed_.push_back(t);
    tets_[t] = tet.nodes;
    materials_[t] = tet.material;
    across_[t] = {kNoTet, kNoTet, kNoTet, kNoTet};
    for (const VertexId v : tet.nodes) {
      tet_at_[v] = t;
    }
  }
  for (std::size_t i = 0; i + 1 < faces_.size(); ++i) {
    if (faces_[i].same_key(faces_[i + 1])) {
      const auto tet = [&](const OpenFace& f) { return f.fresh ? placed_[f.tet] : f.tet; };
      across_[tet(faces_[i])][faces_[i].node] = tet(faces_[i + 1]);
      across_[tet(faces_[i + 1])][faces_[i + 1].node] = tet(faces_[i]);
      ++i;
    }
  }
  return true;
}

VertexId TetComplex::add_vertex(const Vec3& point) {
  points_.push_back(point);
  tet_at_.push_back(kNoTet);
  hold_.push_back(kFree);
  return static_cast<VertexId>(points_.size() - 1);
}

}  // namespace cbc3d
