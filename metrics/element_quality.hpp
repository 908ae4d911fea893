// Shape of the elements.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "mesher/core/mesh.hpp"
#include "metrics/cells.hpp"

namespace cbc3d::metrics {

/// The six dihedral angles of a tetrahedron, degrees in [0,180]; of an inverted one those of its mirror
/// image. Edges in the order 01 02 03 12 13 23.
std::array<double, 6> dihedral_angles_deg(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Verdict's scaled Jacobian of a tetrahedron: 1 regular, .9428 BCC, .7071 right corner, negative inverted;
/// 0 for a degenerate one.
double scaled_jacobian_tet(const std::array<Vec3, 4>& p);
/// Verdict's (1.4) scaled Jacobian of a pyramid: smallest of the four tets on the base corners, 1 when all
/// eight edges are equal; 0 when inverted.
double scaled_jacobian_pyramid(const std::array<Vec3, 5>& p);
/// Smallest base corner Jacobian times sqrt(3): 1 for the pyramid over a face of a body-centred cubic lattice
/// (height half the base). Negative when inverted.
double scaled_jacobian_pyramid_bcc(const std::array<Vec3, 5>& p);
/// Verdict's scaled Jacobian of a wedge: 1 for a right prism over an equilateral triangle.
double scaled_jacobian_wedge(const std::array<Vec3, 6>& p);
/// Verdict's scaled Jacobian of a hexahedron, over corners and centre: 1 for a box.
double scaled_jacobian_hex(const std::array<Vec3, 8>& p);

inline constexpr std::size_t kDihedralBins = 36;
inline constexpr double kDihedralBinDeg = 5;

/// Histogram bin of an angle. An angle within a millionth of a degree below a bin's lower end counts as on
/// it, so that the 60 and 90 degrees of a lattice do not scatter over two bins by rounding.
std::size_t dihedral_bin(double angle_deg);

struct ElementQuality {
  std::optional<double> min_dihedral_deg, max_dihedral_deg;      ///< over the tets
  std::array<std::int64_t, kDihedralBins> dihedral_histogram{};  ///< all six angles of every tet
  std::optional<double> min_sj_tets, min_sj_pyramids, min_sj_pyramids_bcc, min_sj_wedges, min_sj_hexes;
  std::int64_t inverted = 0;  ///< cells whose volume (see split_into_tets) is not positive
};

ElementQuality element_quality(const MeshView& view);

/// Keys: min_dihedral_deg, max_dihedral_deg, dihedral_histogram_5deg (tets only), min_scaled_jacobian
/// (Verdict's, over all cells), inverted, and per kind of cell min_scaled_jacobian_tets, _pyramids,
/// _pyramids_bcc, _wedges, _hexes.
nlohmann::json to_json(const ElementQuality& quality);

}  // namespace cbc3d::metrics
