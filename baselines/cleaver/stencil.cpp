#include "baselines/cleaver/stencil.hpp"

#include <algorithm>

#include "baselines/cleaver/tet_stencil.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

constexpr VertexId kChunkQuad = 0x80000000U;  // marks a quad by its number in its chunk

// The pieces of some mixed tets. Points are numbered: vertices, cuts, triples, quads.
struct Chunk {
  TetNodes tets;
  std::vector<MaterialId> materials;
  std::vector<Vec3> quads;
};

class Cleaver {
 public:
  Cleaver(const CutLattice& cut, const Indicators& indicators, bool keeps_background)
      : cut_(cut), indicators_(indicators), keeps_background_(keeps_background) {}

  [[nodiscard]] Chunk pieces_of_range(std::size_t begin, std::size_t end) const {
    Chunk chunk;
    for (std::size_t m = begin; m < end; ++m) append(cut_.mixed[m], chunk);
    return chunk;
  }

 private:
  void append(const MixedTet& mixed, Chunk& chunk) const {
    const TetState state = state_of(cut_, mixed);
    TetPieces pieces = pieces_of(state);
    if (pieces.uses_quad) keep_quad_on_box(state, pieces);
    const auto quad = static_cast<VertexId>(kChunkQuad + chunk.quads.size());
    bool used = false;
    for (std::size_t n = 0; n < pieces.count; ++n) {
      const TetPiece& piece = pieces.pieces[n];
      const MaterialId material = material_of(mixed, state, piece, pieces.quad_place);
      if (material == kBackground && !keeps_background_) continue;
      used = true;
      add(mixed, piece, quad, material, chunk);
    }
    if (used && pieces.uses_quad) chunk.quads.push_back(pieces.quad_place);
  }

  // Where a corner is beyond the image's box, the quad is on the box, amid the cuts and triples there.
  void keep_quad_on_box(const TetState& state, TetPieces& pieces) const {
    for (std::uint8_t corner = 0; corner < 4; ++corner) {
      if (!indicators_.is_outside(state.places[corner])) continue;
      Vec3 sum{};
      int count = 0;
      for (std::uint8_t p = 4; p < kQuad; ++p) {
        const bool beside =
            p < 10 ? kTetEdge[p - 4U][0] == corner || kTetEdge[p - 4U][1] == corner : p - 10 != corner;
        const bool in_use = p < 10 ? state.cut_at[p - 4U] == p : state.triple_at[p - 10U] == p;
        if (!beside || !in_use) continue;
        sum += state.places[p];
        ++count;
      }
      if (count >= 3) pieces.quad_place = sum / count;
      return;
    }
  }

  // A corner that no cut has been snapped to is inside its material, and so are the pieces at it: corners of
  // several such materials are in no common piece. Other pieces are of the material that goes along their
  // edge up to its cut; where that edge has none it may lie in a boundary, and the piece's middle decides.
  [[nodiscard]] MaterialId material_of(const MixedTet& mixed, TetState state, const TetPiece& piece,
                                       const Vec3& quad_place) const {
    std::array<bool, 4> on_boundary{};
    for (std::size_t e = 0; e < 6; ++e) {
      if (mixed.cuts[e] != kNone && state.cut_at[e] < 4) on_boundary[state.cut_at[e]] = true;
    }
    for (const std::uint8_t p : piece.points) {
      if (p < 4 && !on_boundary[p]) return cut_.materials[state.nodes[p]];
    }
    if (mixed.cuts[piece.edge] != kNone) return cut_.materials[state.nodes[piece.corner]];
    state.places[kQuad] = quad_place;
    Vec3 middle{};
    for (const std::uint8_t p : piece.points) middle += state.places[p] / 4;
    return indicators_.material_at(middle);
  }

  void add(const MixedTet& mixed, const TetPiece& piece, VertexId quad, MaterialId material,
           Chunk& chunk) const {
    std::array<VertexId, 4> nodes{};
    for (std::size_t n = 0; n < 4; ++n) nodes[n] = number_of(mixed, piece.points[n], quad);
    chunk.tets.push_back(nodes);
    chunk.materials.push_back(material);
  }

  [[nodiscard]] VertexId number_of(const MixedTet& mixed, std::uint8_t point, VertexId quad) const {
    const auto vertices = static_cast<VertexId>(cut_.lattice.points.size());
    const auto cuts = static_cast<VertexId>(cut_.cuts.size());
    if (point < 4) return cut_.lattice.tets[mixed.tet][point];
    if (point < 10) return vertices + mixed.cuts[point - 4U];
    return point == kQuad ? quad : vertices + cuts + mixed.triples[point - 10U];
  }

  const CutLattice& cut_;
  const Indicators& indicators_;
  bool keeps_background_;
};

std::vector<Chunk> chunks_of(const CutLattice& cut, const Indicators& indicators, bool keeps_background) {
  constexpr std::size_t kTetsOfChunk = 4096;
  const Cleaver cleaver(cut, indicators, keeps_background);
  std::vector<Chunk> chunks((cut.mixed.size() + kTetsOfChunk - 1) / kTetsOfChunk);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t c = 0; c < chunks.size(); ++c)
    chunks[c] = cleaver.pieces_of_range(c * kTetsOfChunk, std::min(cut.mixed.size(), (c + 1) * kTetsOfChunk));
  return chunks;
}

void append_pure_tets(const CutLattice& cut, bool keeps_background, CleavedMesh& mesh) {
  std::size_t next_mixed = 0;
  for (std::size_t t = 0; t < cut.lattice.tets.size(); ++t) {
    if (next_mixed < cut.mixed.size() && cut.mixed[next_mixed].tet == t) {
      ++next_mixed;
      continue;
    }
    const MaterialId material = cut.materials[cut.lattice.tets[t][0]];
    if (material == kBackground && !keeps_background) continue;
    mesh.tets.push_back(cut.lattice.tets[t]);
    mesh.materials.push_back(material);
  }
}

// Leaves out the points that no tet has.
void number_points(const CutLattice& cut, const std::vector<Vec3>& quads, CleavedMesh& mesh) {
  const std::size_t vertices = cut.lattice.points.size(), cuts = cut.cuts.size(),
                    triples = cut.triples.size();
  std::vector<VertexId> number(vertices + cuts + triples + quads.size(), kNoVertex);
  for (const auto& nodes : mesh.tets) {
    for (const VertexId v : nodes) number[v] = 0;
  }
  VertexId next = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNoVertex) continue;
    number[v] = next++;
    mesh.points.push_back(v < vertices                    ? cut.lattice.points[v]
                          : v < vertices + cuts           ? cut.place_of(cut.cuts[v - vertices])
                          : v < vertices + cuts + triples ? cut.triples[v - vertices - cuts].place
                                                          : quads[v - vertices - cuts - triples]);
  }
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (VertexId& v : mesh.tets[t]) v = number[v];
  }
}

}  // namespace

CleavedMesh cleave_tets(const CutLattice& cut, const Indicators& indicators, bool keeps_background) {
  CleavedMesh mesh;
  append_pure_tets(cut, keeps_background, mesh);
  std::vector<Vec3> quads;
  const auto first_quad =
      static_cast<VertexId>(cut.lattice.points.size() + cut.cuts.size() + cut.triples.size());
  for (Chunk& chunk : chunks_of(cut, indicators, keeps_background)) {
    for (auto& nodes : chunk.tets) {
      for (VertexId& v : nodes) {
        if (v >= kChunkQuad) v = static_cast<VertexId>(first_quad + quads.size() + (v - kChunkQuad));
      }
    }
    mesh.tets.insert(mesh.tets.end(), chunk.tets.begin(), chunk.tets.end());
    mesh.materials.insert(mesh.materials.end(), chunk.materials.begin(), chunk.materials.end());
    quads.insert(quads.end(), chunk.quads.begin(), chunk.quads.end());
  }
  number_points(cut, quads, mesh);
  return mesh;
}

}  // namespace cbc3d::baselines::cleaver
