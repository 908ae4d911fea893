#include "baselines/podm/label_repair.hpp"

#include <algorithm>

namespace cbc3d::baselines::podm {
namespace {

// Maximal sets of tets of one material that are connected by facets.
struct Pieces {
  std::vector<std::uint32_t> of_tet;
  std::vector<std::vector<std::uint32_t>> small;  // tets of the small pieces
  std::vector<std::size_t> sizes;
};

std::vector<std::uint32_t> piece_from(const LabelledComplex& complex, std::uint32_t seed,
                                      std::uint32_t number, std::vector<std::uint32_t>& of_tet) {
  std::vector<std::uint32_t> piece{seed};
  of_tet[seed] = number;
  for (std::size_t n = 0; n < piece.size(); ++n) {
    for (const std::uint32_t t : complex.neighbours[piece[n]]) {
      if (t == kNoTet || of_tet[t] != kNoTet || complex.materials[t] != complex.materials[seed]) continue;
      of_tet[t] = number;
      piece.push_back(t);
    }
  }
  return piece;
}

Pieces find_pieces(const LabelledComplex& complex, std::size_t small) {
  Pieces pieces;
  pieces.of_tet.assign(complex.tets.size(), kNoTet);
  for (std::uint32_t t = 0; t < complex.tets.size(); ++t) {
    if (pieces.of_tet[t] != kNoTet) continue;
    auto piece = piece_from(complex, t, static_cast<std::uint32_t>(pieces.sizes.size()), pieces.of_tet);
    pieces.sizes.push_back(piece.size());
    if (piece.size() < small) pieces.small.push_back(std::move(piece));
  }
  return pieces;
}

// For every material the number of its first largest piece.
std::vector<std::uint32_t> largest_pieces(const LabelledComplex& complex, const Pieces& pieces) {
  std::vector<std::uint32_t> largest;
  for (std::uint32_t t = 0; t < complex.tets.size(); ++t) {
    const MaterialId m = complex.materials[t];
    if (m >= largest.size()) largest.resize(m + std::size_t{1}, kNoTet);
    const std::uint32_t piece = pieces.of_tet[t];
    if (largest[m] == kNoTet || pieces.sizes[piece] > pieces.sizes[largest[m]]) largest[m] = piece;
  }
  return largest;
}

// The material that a piece has most facets with, the lowest of equal ones; its own where it has none.
MaterialId material_around(const LabelledComplex& complex, const std::vector<std::uint32_t>& piece) {
  const MaterialId own = complex.materials[piece.front()];
  std::vector<MaterialId> around;
  for (const std::uint32_t t : piece) {
    for (const std::uint32_t n : complex.neighbours[t]) {
      if (n != kNoTet && complex.materials[n] != own) around.push_back(complex.materials[n]);
    }
  }
  std::sort(around.begin(), around.end());
  MaterialId best = own;
  std::ptrdiff_t most = 0;
  for (auto first = around.begin(); first != around.end();) {
    const auto end = std::upper_bound(first, around.end(), *first);
    if (end - first > most) {
      most = end - first;
      best = *first;
    }
    first = end;
  }
  return best;
}

Vec3 centroid(const LabelledComplex& complex, std::uint32_t tet) {
  Vec3 sum;
  for (const VertexId v : complex.tets[tet]) sum += 0.25 * complex.points[v];
  return sum;
}

}  // namespace

std::size_t repair_orphans(LabelledComplex& complex, std::size_t tets,
                           const std::function<MaterialId(const Vec3&)>& material_at) {
  const Pieces pieces = find_pieces(complex, tets);
  const std::vector<std::uint32_t> largest = largest_pieces(complex, pieces);
  std::size_t changed = 0;
  for (const auto& piece : pieces.small) {
    const MaterialId own = complex.materials[piece.front()];
    if (largest[own] == pieces.of_tet[piece.front()]) continue;
    const auto is_own = [&](std::uint32_t t) { return material_at(centroid(complex, t)) == own; };
    if (std::any_of(piece.begin(), piece.end(), is_own)) continue;
    const MaterialId other = material_around(complex, piece);
    if (other == own) continue;
    for (const std::uint32_t t : piece) complex.materials[t] = other;
    changed += piece.size();
  }
  return changed;
}

Mesh mesh_of(const LabelledComplex& complex, const std::vector<Label>& labels) {
  Mesh mesh;
  std::vector<VertexId> ids(complex.points.size(), kNoVertex);
  for (std::size_t t = 0; t < complex.tets.size(); ++t) {
    if (complex.materials[t] == kBackground) continue;
    std::array<VertexId, 4> nodes = complex.tets[t];
    for (VertexId& node : nodes) {
      if (ids[node] == kNoVertex) {
        ids[node] = static_cast<VertexId>(mesh.points.size());
        mesh.points.push_back(complex.points[node]);
      }
      node = ids[node];
    }
    mesh.tets.add(nodes, labels[complex.materials[t]]);
  }
  return mesh;
}

}  // namespace cbc3d::baselines::podm
