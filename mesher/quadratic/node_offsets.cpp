#include "mesher/quadratic/node_offsets.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d {
namespace {

/// What a sweep of Gauss and Seidel needs of one material: its areas to the others.
struct Row {
  double area_mm2 = 0;
  std::vector<std::pair<MaterialId, double>> others;
};

std::vector<Row> rows_of(const std::vector<OffsetArea>& areas, std::size_t materials) {
  std::vector<Row> rows(materials);
  for (const OffsetArea& area : areas) {
    if (!(area.area_mm2 > 0)) continue;
    for (const auto& [own, other] : {std::pair{area.a, area.b}, std::pair{area.b, area.a}}) {
      rows[own].area_mm2 += area.area_mm2;
      rows[own].others.emplace_back(other, area.area_mm2);
    }
  }
  return rows;
}

}  // namespace

bool NodeOffsets::can_improve(const std::vector<double>& volume_mm3,
                              const std::vector<OffsetArea>& areas) const {
  // As a share of the volume; about what flat facets leave.
  constexpr double kSmallError = 5e-5;
  const std::vector<double>& wanted_mm3 = domain_.volumes_mm3();
  const auto has_hope = [&](MaterialId m) {
    if (m == 0) return false;
    const double small_mm3 = kSmallError * wanted_mm3[m];
    const double now = std::fabs(wanted_mm3[m] - volume_mm3[m]);
    const double before = lack_mm3_.empty() ? 0 : std::fabs(lack_mm3_[m]);
    return now > small_mm3 && (before <= small_mm3 || now < 0.5 * before);
  };
  return std::any_of(areas.begin(), areas.end(), [&](const OffsetArea& area) {
    return area.area_mm2 > 0 && (has_hope(area.a) || has_hope(area.b));
  });
}

void NodeOffsets::update(const std::vector<double>& volume_mm3, const std::vector<OffsetArea>& areas) {
  constexpr int kSweeps = 100;
  const double most_mm = 0.5 * std::cbrt(domain_.cell_mm3());
  const std::vector<double>& wanted_mm3 = domain_.volumes_mm3();
  const std::vector<Row> rows = rows_of(areas, offset_mm_.size());
  const std::vector<double> before_mm = offset_mm_;
  lack_mm3_.resize(rows.size());
  for (std::size_t m = 1; m < rows.size(); ++m) lack_mm3_[m] = wanted_mm3[m] - volume_mm3[m];
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t m = 1; m < rows.size(); ++m) {
      if (rows[m].others.empty()) continue;
      double gain_mm3 = lack_mm3_[m];
      for (const auto& [other, area_mm2] : rows[m].others) {
        gain_mm3 += area_mm2 * (offset_mm_[other] - before_mm[other]);
      }
      offset_mm_[m] = std::clamp(before_mm[m] + gain_mm3 / rows[m].area_mm2, -most_mm, most_mm);
    }
  }
}

}  // namespace cbc3d
