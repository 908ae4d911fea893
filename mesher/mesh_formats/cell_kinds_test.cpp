// The facets of every kind close a cell and point outwards.
#include "mesher/mesh_formats/cell_kinds.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "mesher/core/vec3.hpp"
#include "mesher/topology/quadratic_mesh.hpp"

namespace cbc3d {
namespace {

/// The corners of a cell of volume `volume`, in its order of nodes.
struct Corners {
  std::vector<Vec3> points;
  double volume;
};

const std::vector<Corners> kCells = {
    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 6},
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, 1.0 / 3},
    {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0.5},
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, 1}};

TEST(CellKinds, FacetsPointOutwardsAndCloseTheCell) {
  for (std::size_t kind = 0; kind < kCellKinds.size(); ++kind) {
    const CellKindRow& row = kCellKinds[kind];
    const Corners& cell = kCells[kind];
    ASSERT_EQ(cell.points.size(), row.corners);
    double six_volumes = 0;
    Vec3 area;
    for (std::size_t f = 0; f < row.facets; ++f) {
      for (std::size_t n = 1; n + 1 < 4 && row.facet[f][n + 1] != kNoCorner; ++n) {
        const Vec3 a = cell.points[row.facet[f][0]], b = cell.points[row.facet[f][n]],
                   c = cell.points[row.facet[f][n + 1]];
        six_volumes += a.dot(b.cross(c));
        area += (b - a).cross(c - a);
      }
    }
    EXPECT_NEAR(six_volumes / 6, cell.volume, 1e-12) << row.abaqus;
    EXPECT_NEAR(area.norm(), 0, 1e-12) << row.abaqus;
  }
}

TEST(CellKinds, EdgesOfATriangularFacetAreEdgesOfTheTet) {
  for (const FacetCorners& facet : kQuadraticTet.facet) {
    if (facet[0] == facet[1]) break;  // beyond the last
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint8_t a = facet[n], b = facet[(n + 1) % 3];
      std::size_t found = 0;
      for (const auto& [p, q] : kQuadraticTetEdges) found += (p == a && q == b) || (p == b && q == a) ? 1 : 0;
      EXPECT_EQ(found, 1U);
    }
  }
}

}  // namespace
}  // namespace cbc3d
