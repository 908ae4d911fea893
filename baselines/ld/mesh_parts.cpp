#include "baselines/ld/mesh_parts.hpp"

#include <algorithm>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// A vertex that several parts may have.
struct SharedVertex {
  LatticePoint point;
  VertexId id;  // in the order of the parts
  bool operator<(const SharedVertex& o) const { return point != o.point ? point < o.point : id < o.id; }
};

class Joiner {
 public:
  explicit Joiner(std::vector<LatticeMesh>& parts) : parts_(parts) {}

  LatticeMesh join(const std::vector<LoosePiece>& loose_pieces) {
    list_shared();
    number_vertices();
    std::size_t tets = 0;
    for (const LatticeMesh& part : parts_) tets += part.tets.size();
    mesh_.tets.reserve(tets);
    mesh_.materials.reserve(tets);
    std::size_t before = 0;
    for (LatticeMesh& part : parts_) {
      const std::size_t vertices = part.points.size();
      append(part, &ids_[before]);
      before += vertices;
      part = {};
    }
    for (const LoosePiece& piece : loose_pieces) {
      mesh_.pieces.push_back(
          {piece.corners, {id_of(piece.facet[0]), id_of(piece.facet[1]), id_of(piece.facet[2])}});
    }
    return std::move(mesh_);
  }

 private:
  void list_shared() {
    std::size_t vertices = 0;
    for (const LatticeMesh& part : parts_) {
      for (std::size_t v = 0; v < part.points.size(); ++v, ++vertices) {
        if (part.states[v].is_frozen) shared_.push_back({part.points[v], static_cast<VertexId>(vertices)});
      }
    }
    if (vertices >= kNoVertex)
      throw JobError("the mesh has more vertices than can be numbered; give larger bounds");
    std::sort(shared_.begin(), shared_.end());
    ids_.resize(vertices);
  }

  // Of the vertices at one place all get the number of the first.
  void number_vertices() {
    std::fill(ids_.begin(), ids_.end(), kNoVertex);
    std::vector<VertexId> first_of(ids_.size(), kNoVertex);
    for (std::size_t s = 0, first = 0; s < shared_.size(); ++s) {
      if (shared_[s].point != shared_[first].point) first = s;
      first_of[shared_[s].id] = shared_[first].id;
    }
    std::size_t v = 0;
    for (const LatticeMesh& part : parts_) {
      for (std::size_t own = 0; own < part.points.size(); ++own, ++v) {
        const VertexId first = first_of[v];
        if (first != kNoVertex && first != v) {
          ids_[v] = ids_[first];
          VertexState& state = mesh_.states[ids_[v]];
          state.is_open = state.is_open || part.states[own].is_open;
          continue;
        }
        ids_[v] = static_cast<VertexId>(mesh_.points.size());
        mesh_.points.push_back(part.points[own]);
        mesh_.states.push_back(part.states[own]);
        mesh_.states.back().is_frozen = false;
      }
    }
  }

  void append(const LatticeMesh& part, const VertexId* ids) {
    for (auto nodes : part.tets) {
      for (VertexId& v : nodes) v = ids[v];
      mesh_.tets.push_back(nodes);
    }
    mesh_.materials.insert(mesh_.materials.end(), part.materials.begin(), part.materials.end());
    for (BoundaryPiece piece : part.pieces) {
      for (VertexId& v : piece.facet) v = ids[v];
      mesh_.pieces.push_back(piece);
    }
  }

  [[nodiscard]] VertexId id_of(const LatticePoint& point) const {
    return ids_[std::lower_bound(shared_.begin(), shared_.end(), SharedVertex{point, 0})->id];
  }

  std::vector<LatticeMesh>& parts_;
  std::vector<SharedVertex> shared_;
  std::vector<VertexId> ids_;  // of every vertex of the parts
  LatticeMesh mesh_;
};

/// Sorts the numbers below `count` by their key, which is below `keys`; those of another key are left out.
/// `begins` gets the place of the first of each key, and the end.
template <typename Key>
std::vector<std::uint32_t> sorted_by_key(std::size_t count, std::size_t keys, const Key& key_of,
                                         std::vector<std::size_t>& begins) {
  begins.assign(keys + 1, 0);
  for (std::size_t n = 0; n < count; ++n) {
    if (const std::size_t key = key_of(n); key < keys) ++begins[key + 1];
  }
  for (std::size_t key = 0; key < keys; ++key) begins[key + 1] += begins[key];
  std::vector<std::uint32_t> sorted(begins[keys]);
  std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
  for (std::size_t n = 0; n < count; ++n) {
    if (const std::size_t key = key_of(n); key < keys) sorted[next[key]++] = static_cast<std::uint32_t>(n);
  }
  return sorted;
}

}  // namespace

LatticeMesh joined(std::vector<LatticeMesh>& parts, const std::vector<LoosePiece>& loose_pieces) {
  return Joiner(parts).join(loose_pieces);
}

MeshParts::MeshParts(const LatticeMesh& mesh, int side, int shift) : mesh_(mesh) {
  sort_tets(side, shift);
  find_homes();
  sort_pieces();
}

void MeshParts::sort_tets(int side, int shift) {
  std::array<std::int64_t, 3> boxes{1, 1, 1};
  const auto box_of = [&](const std::array<VertexId, 4>& nodes, std::size_t a) {
    std::int64_t sum = 0;  // eight times the centroid in cells
    for (const VertexId v : nodes) sum += mesh_.points[v][a];
    return (sum + std::int64_t{8} * shift) / (std::int64_t{8} * side);
  };
  for (const LatticePoint& point : mesh_.points) {
    for (std::size_t a = 0; a < 3; ++a)
      boxes[a] = std::max(boxes[a], (point[a] / 2 + shift) / side + std::int64_t{1});
  }
  std::vector<std::uint32_t> box(mesh_.tets.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < box.size(); ++t) {
    const auto& nodes = mesh_.tets[t];
    box[t] = static_cast<std::uint32_t>((box_of(nodes, 2) * boxes[1] + box_of(nodes, 1)) * boxes[0] +
                                        box_of(nodes, 0));
  }
  const auto all = static_cast<std::size_t>(boxes[0] * boxes[1] * boxes[2]);
  tets_ = sorted_by_key(
      box.size(), all, [&](std::size_t t) { return std::size_t{box[t]}; }, begins_);
  begins_.erase(std::unique(begins_.begin(), begins_.end()), begins_.end());
}

void MeshParts::find_homes() {
  homes_.assign(mesh_.points.size(), kNone);
  for (std::size_t part = 0; part < size(); ++part) {
    for (std::size_t n = begins_[part]; n < begins_[part + 1]; ++n) {
      for (const VertexId v : mesh_.tets[tets_[n]]) {
        homes_[v] = homes_[v] == kNone || homes_[v] == part ? static_cast<std::uint32_t>(part) : kSeveral;
      }
    }
  }
  has_work_.assign(size(), 0);
  for (std::size_t v = 0; v < homes_.size(); ++v) {
    if (homes_[v] < kSeveral && mesh_.states[v].is_open) has_work_[homes_[v]] = 1;
  }
}

std::uint32_t MeshParts::home_of(const BoundaryPiece& piece) const {
  return std::min({homes_[piece.facet[0]], homes_[piece.facet[1]], homes_[piece.facet[2]]});
}

void MeshParts::sort_pieces() {
  pieces_ = sorted_by_key(
      mesh_.pieces.size(), size(), [&](std::size_t p) { return std::size_t{home_of(mesh_.pieces[p])}; },
      piece_begins_);
}

LatticeMesh MeshParts::part(std::size_t part) const {
  std::vector<VertexId> vertices;
  for (std::size_t n = begins_[part]; n < begins_[part + 1]; ++n) {
    const auto& nodes = mesh_.tets[tets_[n]];
    vertices.insert(vertices.end(), nodes.begin(), nodes.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  const auto own = [&](VertexId v) {
    return static_cast<VertexId>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
  };
  LatticeMesh mesh;
  for (const VertexId v : vertices) {
    mesh.points.push_back(mesh_.points[v]);
    mesh.states.push_back(mesh_.states[v]);
    mesh.states.back().is_frozen = homes_[v] == kSeveral;
  }
  for (std::size_t n = begins_[part]; n < begins_[part + 1]; ++n) {
    auto nodes = mesh_.tets[tets_[n]];
    for (VertexId& v : nodes) v = own(v);
    mesh.tets.push_back(nodes);
    mesh.materials.push_back(mesh_.materials[tets_[n]]);
  }
  for (std::size_t n = piece_begins_[part]; n < piece_begins_[part + 1]; ++n) {
    BoundaryPiece piece = mesh_.pieces[pieces_[n]];
    for (VertexId& v : piece.facet) v = own(v);
    mesh.pieces.push_back(piece);
  }
  return mesh;
}

std::vector<LoosePiece> MeshParts::loose_pieces() const {
  std::vector<LoosePiece> loose;
  for (const BoundaryPiece& piece : mesh_.pieces) {
    if (home_of(piece) != kSeveral) continue;
    loose.push_back(
        {piece.corners,
         {mesh_.points[piece.facet[0]], mesh_.points[piece.facet[1]], mesh_.points[piece.facet[2]]}});
  }
  return loose;
}

}  // namespace cbc3d::baselines::ld
