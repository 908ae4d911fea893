// Shape of the elements of a mesh: extremes, histogram, percentiles and counts of what is broken.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "metrics/cells.hpp"
#include "metrics/element_shapes.hpp"

namespace cbc3d::metrics {

inline constexpr std::size_t kDihedralBins = 36;
inline constexpr double kDihedralBinDeg = 5;

/// Histogram bin of an angle. An angle within a millionth of a degree below a bin's lower end counts as on
/// it, so that the 60 and 90 degrees of a lattice do not scatter over two bins by rounding.
std::size_t dihedral_bin(double angle_deg);

/// The percentiles that are given of every measure.
inline constexpr std::array<int, 7> kPercentiles{1, 5, 25, 50, 75, 95, 99};
/// Values at kPercentiles: the smallest value that at least that percentage of the values does not exceed, in
/// single precision. Nothing of no values.
using Percentiles = std::optional<std::array<double, kPercentiles.size()>>;
/// Reorders the values.
Percentiles percentiles_of(std::vector<float>& values);

/// The cells of one label, or all. A measure is empty where there is no cell of its kind.
struct ElementQuality {
  std::int64_t cells = 0;
  std::optional<double> min_dihedral_deg, max_dihedral_deg;      ///< over the tets
  std::array<std::int64_t, kDihedralBins> dihedral_histogram{};  ///< all six angles of every tet
  Percentiles dihedral_deg;
  std::optional<double> max_radius_ratio, min_mean_ratio;  ///< over the tets; see element_shapes.hpp
  Percentiles radius_ratio, mean_ratio;
  std::optional<double> min_sj_tets, min_sj_pyramids, min_sj_pyramids_bcc, min_sj_wedges, min_sj_hexes;
  Percentiles scaled_jacobian;         ///< Verdict's, over all cells
  std::int64_t inverted = 0;           ///< cells whose volume (see split_into_tets) is not positive
  std::int64_t degenerate = 0;         ///< of these, volume zero: below 1e-12 of the longest side cubed
  std::int64_t negative_jacobian = 0;  ///< cells whose scaled Jacobian is not positive: folded at a corner
  std::optional<std::size_t> first_inverted;  ///< number of the first inverted cell, see MeshView
};

struct MeshQuality {
  ElementQuality all;
  std::vector<ElementQuality> per_label;  ///< by index into MeshView::labels()
};

/// Time n; memory about 100 bytes a cell.
MeshQuality element_quality(const MeshView& view);

/// Of a mesh of more labels the histogram and percentiles of single labels are null: nobody reads them, and
/// they would be gigabytes.
inline constexpr std::size_t kMostLabelsInFull = 10000;

/// Keys: cells, min_dihedral_deg, max_dihedral_deg, dihedral_histogram_5deg, dihedral_percentiles_deg,
/// max_radius_ratio, radius_ratio_percentiles, min_mean_ratio, mean_ratio_percentiles (these tets only),
/// min_scaled_jacobian and scaled_jacobian_percentiles (Verdict's, over all cells), per kind of cell
/// min_scaled_jacobian_tets, _pyramids, _pyramids_bcc, _wedges, _hexes, inverted, degenerate,
/// negative_jacobian; scaled_jacobian_norms names the normalisation of each kind; per_label has label and the
/// same. Percentiles are objects p1 ... p99.
nlohmann::json to_json(const MeshQuality& quality, const MeshView& view);

}  // namespace cbc3d::metrics
