#include "metrics/element_quality.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "metrics/box_tree.hpp"
#include "metrics/element_corners.hpp"
#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDegenerateVolume = 1e-12;

// Running figures of one thread; merging is exact (min, max, integer sums), so its order does not matter.
struct Running {
  std::int64_t cells = 0;
  double min_dihedral = kInfinity, max_dihedral = -kInfinity;
  std::array<std::int64_t, kDihedralBins> histogram{};
  double max_radius_ratio = -kInfinity, min_mean_ratio = kInfinity;
  double tets = kInfinity, pyramids = kInfinity, pyramids_bcc = kInfinity, wedges = kInfinity,
         hexes = kInfinity;
  std::int64_t inverted = 0, degenerate = 0, negative = 0;
  std::size_t first_inverted = std::numeric_limits<std::size_t>::max();

  void merge(const Running& o) {
    cells += o.cells;
    min_dihedral = std::min(min_dihedral, o.min_dihedral);
    max_dihedral = std::max(max_dihedral, o.max_dihedral);
    for (std::size_t b = 0; b < kDihedralBins; ++b) {
      histogram[b] += o.histogram[b];
    }
    max_radius_ratio = std::max(max_radius_ratio, o.max_radius_ratio);
    min_mean_ratio = std::min(min_mean_ratio, o.min_mean_ratio);
    tets = std::min(tets, o.tets);
    pyramids = std::min(pyramids, o.pyramids);
    pyramids_bcc = std::min(pyramids_bcc, o.pyramids_bcc);
    wedges = std::min(wedges, o.wedges);
    hexes = std::min(hexes, o.hexes);
    inverted += o.inverted;
    degenerate += o.degenerate;
    negative += o.negative;
    first_inverted = std::min(first_inverted, o.first_inverted);
  }
};

// What percentiles are taken of.
struct Values {
  std::vector<float> dihedrals, radius_ratios, mean_ratios, jacobians;

  void append(const Values& o) {
    const auto add = [](std::vector<float>& to, const std::vector<float>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    add(dihedrals, o.dihedrals);
    add(radius_ratios, o.radius_ratios);
    add(mean_ratios, o.mean_ratios);
    add(jacobians, o.jacobians);
  }
};

double add_tet(const std::array<Vec3, 4>& p, Running& running, Values& values) {
  for (const double angle : dihedral_angles_deg(p[0], p[1], p[2], p[3])) {
    running.min_dihedral = std::min(running.min_dihedral, angle);
    running.max_dihedral = std::max(running.max_dihedral, angle);
    ++running.histogram[dihedral_bin(angle)];
    values.dihedrals.push_back(static_cast<float>(angle));
  }
  const double radius_ratio = radius_ratio_tet(p), mean_ratio = mean_ratio_tet(p);
  running.max_radius_ratio = std::max(running.max_radius_ratio, radius_ratio);
  running.min_mean_ratio = std::min(running.min_mean_ratio, mean_ratio);
  values.radius_ratios.push_back(static_cast<float>(radius_ratio));
  values.mean_ratios.push_back(static_cast<float>(mean_ratio));
  const double jacobian = scaled_jacobian_tet(p);
  running.tets = std::min(running.tets, jacobian);
  return jacobian;
}

double add_pyramid(const std::array<Vec3, 5>& p, Running& running) {
  const double jacobian = scaled_jacobian_pyramid(p);
  running.pyramids = std::min(running.pyramids, jacobian);
  running.pyramids_bcc = std::min(running.pyramids_bcc, scaled_jacobian_pyramid_bcc(p));
  return jacobian;
}

// Returns Verdict's scaled Jacobian.
double add_shape(const CellView& cell, const std::vector<Vec3>& points, Running& running, Values& values) {
  double jacobian = 0;
  switch (cell.kind) {
    case CellKind::kTet:
      return add_tet(node_positions<4>(cell, points), running, values);
    case CellKind::kPyramid:
      return add_pyramid(node_positions<5>(cell, points), running);
    case CellKind::kWedge:
      jacobian = scaled_jacobian_wedge(node_positions<6>(cell, points));
      running.wedges = std::min(running.wedges, jacobian);
      break;
    case CellKind::kHex:
      jacobian = scaled_jacobian_hex(node_positions<8>(cell, points));
      running.hexes = std::min(running.hexes, jacobian);
      break;
  }
  return jacobian;
}

void add_volume(const CellView& cell, std::size_t number, const std::vector<Vec3>& points, Running& running) {
  const TetSplit split = split_into_tets(cell);
  double volume = 0;
  for (int t = 0; t < split.count; ++t) {
    const auto& tet = split.tets[static_cast<std::size_t>(t)];
    volume += six_volumes(points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]) / 6;
  }
  Box box;
  for (const VertexId v : cell.nodes) {
    box.add(points[v]);
  }
  const double side = (box.high - box.low).max_coeff();
  // A flat cell is one whose volume is rounding, of either sign.
  if (std::fabs(volume) <= kDegenerateVolume * side * side * side) {
    ++running.degenerate;
    volume = 0;
  }
  if (!(volume > 0)) {
    ++running.inverted;
    running.first_inverted = std::min(running.first_inverted, number);
  }
}

std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<double> min_of(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

ElementQuality finish(const Running& total, Values& values) {
  ElementQuality quality;
  quality.cells = total.cells;
  quality.min_dihedral_deg = finite(total.min_dihedral);
  quality.max_dihedral_deg = finite(total.max_dihedral);
  quality.dihedral_histogram = total.histogram;
  quality.dihedral_deg = percentiles_of(values.dihedrals);
  quality.max_radius_ratio = finite(total.max_radius_ratio);
  quality.min_mean_ratio = finite(total.min_mean_ratio);
  quality.radius_ratio = percentiles_of(values.radius_ratios);
  quality.mean_ratio = percentiles_of(values.mean_ratios);
  quality.min_sj_tets = finite(total.tets);
  quality.min_sj_pyramids = finite(total.pyramids);
  quality.min_sj_pyramids_bcc = finite(total.pyramids_bcc);
  quality.min_sj_wedges = finite(total.wedges);
  quality.min_sj_hexes = finite(total.hexes);
  quality.scaled_jacobian = percentiles_of(values.jacobians);
  quality.inverted = total.inverted;
  quality.degenerate = total.degenerate;
  quality.negative_jacobian = total.negative;
  if (total.inverted > 0) {
    quality.first_inverted = total.first_inverted;
  }
  return quality;
}

nlohmann::json percentiles_json(const Percentiles& percentiles) {
  if (!percentiles) {
    return nullptr;
  }
  nlohmann::json object;
  for (std::size_t p = 0; p < kPercentiles.size(); ++p) {
    object["p" + std::to_string(kPercentiles[p])] = number_or_null((*percentiles)[p]);
  }
  return object;
}

// `in_full`: with the distributions.
nlohmann::json one_json(const ElementQuality& quality, bool in_full) {
  const auto distribution = [in_full](const Percentiles& percentiles) {
    return in_full ? percentiles_json(percentiles) : nlohmann::json(nullptr);
  };
  const std::optional<double> smallest = min_of(min_of(quality.min_sj_tets, quality.min_sj_pyramids),
                                                min_of(quality.min_sj_wedges, quality.min_sj_hexes));
  return {{"cells", quality.cells},
          {"min_dihedral_deg", number_or_null(quality.min_dihedral_deg)},
          {"max_dihedral_deg", number_or_null(quality.max_dihedral_deg)},
          {"dihedral_histogram_5deg",
           in_full ? nlohmann::json(quality.dihedral_histogram) : nlohmann::json(nullptr)},
          {"dihedral_percentiles_deg", distribution(quality.dihedral_deg)},
          {"max_radius_ratio", number_or_null(quality.max_radius_ratio)},
          {"radius_ratio_percentiles", distribution(quality.radius_ratio)},
          {"min_mean_ratio", number_or_null(quality.min_mean_ratio)},
          {"mean_ratio_percentiles", distribution(quality.mean_ratio)},
          {"min_scaled_jacobian", number_or_null(smallest)},
          {"scaled_jacobian_percentiles", distribution(quality.scaled_jacobian)},
          {"min_scaled_jacobian_tets", number_or_null(quality.min_sj_tets)},
          {"min_scaled_jacobian_pyramids", number_or_null(quality.min_sj_pyramids)},
          {"min_scaled_jacobian_pyramids_bcc", number_or_null(quality.min_sj_pyramids_bcc)},
          {"min_scaled_jacobian_wedges", number_or_null(quality.min_sj_wedges)},
          {"min_scaled_jacobian_hexes", number_or_null(quality.min_sj_hexes)},
          {"inverted", quality.inverted},
          {"degenerate", quality.degenerate},
          {"negative_jacobian", quality.negative_jacobian}};
}

// Running figures and values per label: cells in blocks of fixed length, added up in order, so that the
// values come in the same order at any thread count.
// Only the labels that a block holds take room in it.
struct LabelBlock {
  std::vector<std::uint32_t> labels;  // ascending
  std::vector<Running> running;
  std::vector<Values> values;
};

LabelBlock empty_block(const MeshView& view, std::size_t begin, std::size_t end,
                       std::vector<std::uint32_t>& place) {
  std::vector<std::uint8_t> present(view.labels().size(), 0);
  for (std::size_t c = begin; c < end; ++c) {
    present[view.label_index(c)] = 1;
  }
  LabelBlock block;
  place.assign(present.size(), 0);
  for (std::uint32_t l = 0; l < present.size(); ++l) {
    if (present[l] != 0) {
      place[l] = static_cast<std::uint32_t>(block.labels.size());
      block.labels.push_back(l);
    }
  }
  block.running.resize(block.labels.size());
  block.values.resize(block.labels.size());
  return block;
}

LabelBlock measure_block(const MeshView& view, std::size_t begin, std::size_t end) {
  // On the physical coordinates: there a positive cell is positive whatever the image's axes.
  const std::vector<Vec3>& points = view.mesh().points;
  std::vector<std::uint32_t> place;
  LabelBlock block = empty_block(view, begin, end, place);
  for (std::size_t c = begin; c < end; ++c) {
    const CellView cell = view.cell(c);
    Running& running = block.running[place[view.label_index(c)]];
    Values& values = block.values[place[view.label_index(c)]];
    ++running.cells;
    add_volume(cell, c, points, running);
    const double jacobian = add_shape(cell, points, running, values);
    running.negative += jacobian > 0 ? 0 : 1;
    values.jacobians.push_back(static_cast<float>(jacobian));
  }
  return block;
}

}  // namespace

std::size_t dihedral_bin(double angle_deg) {
  constexpr double kSnapDeg = 1e-6;
  const double bin = std::floor((angle_deg + kSnapDeg) / kDihedralBinDeg);
  return static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(kDihedralBins - 1)));
}

Percentiles percentiles_of(std::vector<float>& values) {
  if (values.empty()) {
    return std::nullopt;
  }
  std::array<double, kPercentiles.size()> result{};
  auto begin = values.begin();
  for (std::size_t p = 0; p < kPercentiles.size(); ++p) {
    const std::size_t rank = (values.size() * static_cast<std::size_t>(kPercentiles[p]) + 99) / 100 - 1;
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(begin, at, values.end());
    result[p] = static_cast<double>(*at);
    begin = at;
  }
  return result;
}

MeshQuality element_quality(const MeshView& view) {
  constexpr std::size_t kBlock = 32768;
  const std::size_t labels = view.labels().size(), blocks = (view.cell_count() + kBlock - 1) / kBlock;
  std::vector<LabelBlock> measured(blocks);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < blocks; ++b) {
    measured[b] = measure_block(view, b * kBlock, std::min(view.cell_count(), (b + 1) * kBlock));
  }
  // One more for all labels together.
  std::vector<Running> running(labels + 1);
  std::vector<Values> values(labels + 1);
  for (LabelBlock& block : measured) {
    for (std::size_t n = 0; n < block.labels.size(); ++n) {
      const std::uint32_t l = block.labels[n];
      running[l].merge(block.running[n]);
      running[labels].merge(block.running[n]);
      values[l].append(block.values[n]);
      values[labels].append(block.values[n]);
    }
    block = {};
  }
  MeshQuality quality;
  quality.per_label.resize(labels);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t l = 0; l <= labels; ++l) {
    ElementQuality& one = l < labels ? quality.per_label[l] : quality.all;
    one = finish(running[l], values[l]);
  }
  return quality;
}

nlohmann::json to_json(const MeshQuality& quality, const MeshView& view) {
  nlohmann::json object = one_json(quality.all, true);
  object["scaled_jacobian_norms"] = {
      {"tets", "Verdict: 1 for the regular tet"},
      {"pyramids", "Verdict 1.4: 1 for the pyramid with eight equal edges"},
      {"pyramids_bcc", "base corners times sqrt(3): 1 for the pyramid of a body-centred cubic lattice"},
      {"wedges", "Verdict: 1 for the right prism over an equilateral triangle"},
      {"hexes", "Verdict: 1 for the box, over corners and centre"}};
  auto per_label = nlohmann::json::array();
  for (std::size_t l = 0; l < quality.per_label.size(); ++l) {
    per_label.push_back(one_json(quality.per_label[l], quality.per_label.size() <= kMostLabelsInFull));
    per_label.back()["label"] = view.labels()[l];
  }
  object["per_label"] = std::move(per_label);
  return object;
}

}  // namespace cbc3d::metrics
