// The lattice with what cuts it: cuts on edges, triples on faces (Bronson, Levine and Whitaker 2014, section
// 3).
//
// Notation: corners 0..3 of a lattice tet; its edge e joins the corners kTetEdge[e]; its face i lies opposite
// corner i and has the corners kTetFace[i], counter-clockwise seen from inside, as tets are positive.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "baselines/cleaver/background_lattice.hpp"
#include "baselines/cleaver/indicators.hpp"

namespace cbc3d::baselines::cleaver {

inline constexpr std::array<std::array<std::uint8_t, 2>, 6> kTetEdge{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::uint8_t, 3>, 4> kTetFace{
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
/// The edge between two corners.
inline constexpr std::array<std::array<std::uint8_t, 4>, 4> kEdgeBetween{
    {{{6, 0, 1, 2}}, {{0, 6, 3, 4}}, {{1, 3, 6, 5}}, {{2, 4, 5, 6}}}};

inline constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// Where a cut is: within its edge, or snapped to one of its ends.
enum class CutPlace : std::uint8_t { kWithin, kAtFirst, kAtSecond };

/// The place on an edge where the material of its first vertex gives way to that of its second.
struct Cut {
  VertexId first, second;  ///< first < second
  float fraction = 0.5F;   ///< of the way from the first vertex to the second
  float alpha_first = 0;   ///< fractions of the edge, from either end, within which the cut violates the end
  float alpha_second = 0;
  CutPlace place = CutPlace::kWithin;
};

/// The place on a face with three materials where they meet, of faces with two cuts or three within.
struct Triple {
  std::array<VertexId, 3> corners{};    ///< ascending
  std::array<std::uint32_t, 3> cuts{};  ///< on the edge opposite each corner
  Vec3 place;
  std::uint32_t snapped_to = kNone;  ///< the cut that it has been snapped to
};

/// A tet with corners of several materials.
struct MixedTet {
  std::uint32_t tet;
  std::array<std::uint32_t, 6> cuts;     ///< of its edges; kNone where the ends have one material
  std::array<std::uint32_t, 4> triples;  ///< of its faces; kNone where there is none
};

struct CutLattice {
  Lattice lattice;
  std::vector<MaterialId> materials;  ///< of the vertices
  std::vector<Cut> cuts;
  std::vector<Triple> triples;
  std::vector<MixedTet> mixed;

  [[nodiscard]] Vec3 place_of(const Cut& cut) const {
    if (cut.place == CutPlace::kAtFirst) return lattice.points[cut.first];
    if (cut.place == CutPlace::kAtSecond) return lattice.points[cut.second];
    return lattice.points[cut.first] +
           (lattice.points[cut.second] - lattice.points[cut.first]) * static_cast<double>(cut.fraction);
  }
};

/// Finds the mixed tets of a lattice and the cut of each edge whose ends have different materials.
CutLattice cut_edges(Lattice lattice, std::vector<MaterialId> materials, const Indicators& indicators);

}  // namespace cbc3d::baselines::cleaver
