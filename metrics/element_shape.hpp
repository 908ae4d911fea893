// Shape of the elements as an interpolation error sees it: mean ratio, radius ratio, edge ratio, height
// ratio, and their distributions over a mesh.
//
// Notation: e1, e2, e3  right-handed edges from a corner of an element, A = [e1 e2 e3];
//           W           the same at the corner of the ideal element of its kind, T = A W^-1;
//           |T|         Frobenius norm.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// Mean ratio of the elements that have several corners: the smallest over the corners of 3 |det T|^(2/3) /
/// |T|^2, with the sign of det T (Knupp, SIAM J. Sci. Comput. 23, 2001: algebraic mesh quality metrics). 1
/// for the ideal element, 0 for a flat corner, negative for an inverted one. At the corner of a tet it is
/// mean_ratio_tet. The ideal pyramid has eight equal edges; the apex, at which four edges meet, does not
/// count.
double mean_ratio_pyramid(const std::array<Vec3, 5>& p);
/// The ideal wedge is the right prism with nine equal edges.
double mean_ratio_wedge(const std::array<Vec3, 6>& p);
/// The ideal hex is the cube.
double mean_ratio_hex(const std::array<Vec3, 8>& p);

/// 3 r / R, inradius over circumradius: 1 regular, 0 flat; the inverse of radius_ratio_tet.
double inverse_radius_ratio_tet(const std::array<Vec3, 4>& p);
/// Smallest height over longest edge, times sqrt(3/2): 1 regular, 0 flat.
double height_ratio_tet(const std::array<Vec3, 4>& p);
/// The edges of a kind of cell, by local node numbers.
using LocalEdge = std::array<std::size_t, 2>;
std::span<const LocalEdge> edges_of(CellKind kind);
/// Longest over shortest edge of an element of any kind, at least 1; infinite with an edge of length 0.
double edge_ratio(const CellView& cell, const std::vector<Vec3>& points);

/// A distribution of a measure of which 1 is best. Order statistics are exact, of values in single precision.
struct ShapeDistribution {
  double min = 0, p0_1 = 0, p1 = 0, p5 = 0, median = 0;
  double below_0_3_percent = 0;
};

struct EdgeRatioDistribution {
  double median = 0, p99 = 0, max = 0;
};

/// The elements of a label, of a kind, or all. Nothing where there is no element that the measure is defined
/// for.
struct ElementShape {
  std::optional<ShapeDistribution> mean_ratio;                  ///< of all kinds
  std::optional<ShapeDistribution> radius_ratio, height_ratio;  ///< of tets
  std::optional<EdgeRatioDistribution> edge_ratio;              ///< of all kinds
};

struct MeshShape {
  ElementShape all;
  std::vector<ElementShape>
      per_label;  ///< by index into MeshView::labels(); none of more than kMostLabelsInFull
  std::array<ElementShape, 4> per_kind;  ///< by CellKind
};

/// Expected time n, memory 24 bytes a cell.
MeshShape element_shape(const MeshView& view);

/// Writes into the section `quality` mean_ratio, radius_ratio and height_ratio ({min, p0_1, p1, p5, median,
/// below_0_3_percent}) and edge_ratio ({median, p99, max}); the same into each row of its per_label where
/// there are not too many; and shape_per_kind with mean_ratio and edge_ratio of tets, pyramids, wedges and
/// hexes. Null where there is no such element.
void write_json(nlohmann::json& quality, const MeshShape& shape);

}  // namespace cbc3d::metrics
