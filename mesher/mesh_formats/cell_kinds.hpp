// The kinds of cells and what the formats call them. Facets are listed counter-clockwise seen from outside,
// in the order of Abaqus's faces S1, S2, ... (Abaqus Analysis User's Guide, "Three-dimensional solid element
// library"), whose node orders are ours.
#pragma once

#include <array>
#include <cstdint>

namespace cbc3d {

enum class CellKind : std::uint8_t { tet, pyramid, wedge, hex };

inline constexpr std::uint8_t kNoCorner = 255;

/// The corners of a cell that make a facet; the fourth of a triangle is kNoCorner.
using FacetCorners = std::array<std::uint8_t, 4>;

struct CellKindRow {
  std::uint8_t corners, facets;
  std::array<FacetCorners, 6> facet;
  int vtk, gmsh;
  const char *abaqus, *febio, *medit;
};

/// One row for each kind, in the order of CellKind.
inline constexpr std::array<CellKindRow, 4> kCellKinds = {{
    {4,
     4,
     {{{0, 2, 1, kNoCorner}, {0, 1, 3, kNoCorner}, {1, 2, 3, kNoCorner}, {2, 0, 3, kNoCorner}}},
     10,
     4,
     "C3D4",
     "tet4",
     "Tetrahedra"},
    {5,
     5,
     {{{0, 3, 2, 1}, {0, 1, 4, kNoCorner}, {1, 2, 4, kNoCorner}, {2, 3, 4, kNoCorner}, {3, 0, 4, kNoCorner}}},
     14,
     7,
     "C3D5",
     "pyra5",
     "Pyramids"},
    {6,
     5,
     {{{0, 2, 1, kNoCorner}, {3, 4, 5, kNoCorner}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
     13,
     6,
     "C3D6",
     "penta6",
     "Prisms"},
    {8,
     6,
     {{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
     12,
     5,
     "C3D8",
     "hex8",
     "Hexahedra"},
}};

/// A tet of ten nodes.
inline constexpr CellKindRow kQuadraticTet = {4,       4,       kCellKinds[0].facet, 24, 11,
                                              "C3D10", "tet10", "TetrahedraP2"};

inline constexpr const CellKindRow& row_of(CellKind kind) {
  return kCellKinds[static_cast<std::size_t>(kind)];
}

}  // namespace cbc3d
