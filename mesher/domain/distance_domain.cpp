#include "mesher/domain/distance_domain.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/domain/tolerances.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

DistanceDomain::DistanceDomain(std::vector<Region> regions, const Grid& grid) : regions_(std::move(regions)) {
  for (const Region& region : regions_) {
    label_of_.push_back(static_cast<MaterialId>(labels_.size()));
    labels_.push_back(region.label);
  }
  cells_.frame.size = grid.size;
  cells_.frame.spacing_mm = {grid.spacing_mm, grid.spacing_mm, grid.spacing_mm};
  cells_.labels = labels_;
  cells_.voxels = LabelVoxels(cells_.frame.voxel_count());
  cells_.voxels.hold(labels_.size());
  volumes_mm3_.assign(labels_.size(), 0.0);
  for (std::size_t c = 0; c < cells_.frame.voxel_count(); ++c) {
    const Index3 at = cells_.frame.index_of(c);
    const MaterialId material = material_at(cells_.frame.local_centre(at[0], at[1], at[2]));
    cells_.voxels.set(c, material);
    volumes_mm3_[material] += material == kBackground ? 0 : cell_mm3();
  }
}

double DistanceDomain::scale_mm() const {
  return cells_.frame.voxel_diagonal_mm();
}

double DistanceDomain::cell_mm3() const {
  const double spacing_mm = cells_.frame.spacing_mm.x;
  return spacing_mm * spacing_mm * spacing_mm;
}

std::vector<BoundarySample> DistanceDomain::find_samples() const {
  return boundary_samples(cells_);
}

double DistanceDomain::distance_of(MaterialId material, const Vec3& x) const {
  if (material != kBackground) {
    return regions_[material - 1U].distance_mm(x);
  }
  double largest = -kInfinity;
  for (const Region& region : regions_) {
    largest = std::max(largest, region.distance_mm(x));
  }
  return -largest;
}

MaterialId DistanceDomain::material_at(const Vec3& x) const {
  double largest = 0;
  MaterialId material = kBackground;
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    const double distance_mm = regions_[r].distance_mm(x);
    if (distance_mm > largest) {
      largest = distance_mm;
      material = static_cast<MaterialId>(r + 1);
    }
  }
  return material;
}

BoundaryDistance DistanceDomain::to_zero(const Field& field, const Vec3& x) const {
  const double step_mm = 1e-4 * scale_mm();
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 low = x;
    Vec3 high = x;
    low[axis] -= step_mm;
    high[axis] += step_mm;
    gradient[axis] = (field(high) - field(low)) / (2 * step_mm);
  }
  const double slope = gradient.norm();
  if (!(slope > 0)) {
    return {.deviation_mm = kInfinity};
  }
  const double distance_mm = field(x) / slope;
  return {distance_mm, gradient / slope, std::fabs(distance_mm), true};
}

BoundaryDistance DistanceDomain::boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const {
  const BoundaryDistance near =
      to_zero([&](const Vec3& at) { return 0.5 * (distance_of(a, at) - distance_of(b, at)); }, x);
  if (near.deviation_mm > tolerances::kNearestSearch * scale_mm()) {
    return {.deviation_mm = kInfinity};
  }
  const Vec3 foot = x - near.distance_mm * near.normal;
  const double here = std::max(distance_of(a, foot), distance_of(b, foot));
  for (std::size_t n = 0; n < labels_.size(); ++n) {
    const auto m = static_cast<MaterialId>(n);
    if (m != a && m != b && distance_of(m, foot) > here + scale_mm()) {
      return {.deviation_mm = kInfinity};
    }
  }
  return near;
}

std::optional<Vec3> DistanceDomain::nearest_boundary(const Vec3& x, MaterialId material) const {
  const BoundaryDistance near = to_zero([&](const Vec3& at) { return distance_of(material, at); }, x);
  if (near.deviation_mm > tolerances::kNearestSearch * scale_mm()) {
    return std::nullopt;
  }
  return x - near.distance_mm * near.normal;
}

bool DistanceDomain::is_near_boundary(const Vec3& x, MaterialId material) const {
  const BoundaryDistance near = to_zero([&](const Vec3& at) { return distance_of(material, at); }, x);
  return near.deviation_mm <= tolerances::kFarLimit * scale_mm();
}

}  // namespace cbc3d
