#include "baselines/cleaver/sizing_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "baselines/cleaver/distance_transform.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

using Distances = CellArray<std::uint16_t>;

constexpr float kAnySize = 1e9F;
// Sums of squared second differences of the distance: from kRidge on, a cell is on the medial axis; from
// kHalfRidge on, it may be one of two cells between which the axis runs. The values are the original's.
constexpr double kRidge = 2.75;
constexpr double kHalfRidge = 0.8;
// The original marches its distances from the smooth boundary, which makes them larger than those between
// cells and its cells larger. These factors give its element counts on real images (see README.md).
constexpr double kFeatureFactor = 1.9;
constexpr double kGrowthFactor = 1.5;

// Calls f(i, j, k) for the cells of a layer that have all six neighbours.
template <typename F>
void for_inner_cells(const Index3& size, const F& f) {
#pragma omp parallel for schedule(static)
  for (int k = 1; k < size[2] - 1; ++k) {
    for (int j = 1; j < size[1] - 1; ++j) {
      for (int i = 1; i < size[0] - 1; ++i) f(i, j, k);
    }
  }
}

bool differs_from_neighbour(const CellArray<MaterialId>& materials, int i, int j, int k) {
  const MaterialId own = materials.at(i, j, k);
  return materials.at(i - 1, j, k) != own || materials.at(i + 1, j, k) != own ||
         materials.at(i, j - 1, k) != own || materials.at(i, j + 1, k) != own ||
         materials.at(i, j, k - 1) != own || materials.at(i, j, k + 1) != own;
}

Distances boundary_distances(const CellArray<MaterialId>& materials) {
  Distances distances(materials.size, kFarSquared);
  for_inner_cells(materials.size, [&](int i, int j, int k) {
    if (differs_from_neighbour(materials, i, j, k)) distances.at(i, j, k) = 0;
  });
  squared_distances(distances);
  return distances;
}

double distance_at(const Distances& squared, int i, int j, int k) {
  return std::sqrt(static_cast<double>(squared.at(i, j, k)));
}

double second_difference(const Distances& d, std::size_t axis, int i, int j, int k) {
  const Index3 s{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
  return distance_at(d, i - s[0], j - s[1], k - s[2]) - 2 * distance_at(d, i, j, k) +
         distance_at(d, i + s[0], j + s[1], k + s[2]);
}

double ridge_strength(const Distances& d, int i, int j, int k) {
  if (d.at(i, j, k) == 0 || d.at(i, j, k) == kFarSquared) return 0;
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double second = second_difference(d, axis, i, j, k);
    sum += second * second;
  }
  return sum;
}

// The strength of a ridge between a cell and the next one along an axis.
double double_ridge_strength(const Distances& d, std::size_t axis, int i, int j, int k) {
  const Index3 s{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
  double sum = 0;
  for (std::size_t other = 0; other < 3; ++other) {
    const double second = other != axis
                              ? second_difference(d, other, i, j, k)
                              : distance_at(d, i - s[0], j - s[1], k - s[2]) - distance_at(d, i, j, k) -
                                    distance_at(d, i + s[0], j + s[1], k + s[2]) +
                                    distance_at(d, i + 2 * s[0], j + 2 * s[1], k + 2 * s[2]);
    sum += second * second;
  }
  return sum;
}

bool is_beside_double_ridge(const Distances& d, double strength, int i, int j, int k) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Index3 s{axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
    // The cell may be either of the two.
    for (const int step : {0, -1}) {
      const int x = i + step * s[0], y = j + step * s[1], z = k + step * s[2];
      const bool room = d.contains(x - 1, y - 1, z - 1) && d.contains(x + 2, y + 2, z + 2);
      if (!room) continue;
      const double first = step == 0 ? strength : ridge_strength(d, x, y, z);
      if (first < kHalfRidge || first > kRidge) continue;
      if (ridge_strength(d, x + s[0], y + s[1], z + s[2]) <= 0.5) continue;
      if (double_ridge_strength(d, axis, x, y, z) > kRidge) return true;
    }
  }
  return false;
}

// Squared distances from the medial axis.
Distances medial_distances(const Distances& boundary) {
  Distances medial(boundary.size, kFarSquared);
  for_inner_cells(boundary.size, [&](int i, int j, int k) {
    const double strength = ridge_strength(boundary, i, j, k);
    if (strength > kRidge || (strength > 0.5 && is_beside_double_ridge(boundary, strength, i, j, k)))
      medial.at(i, j, k) = 0;
  });
  squared_distances(medial);
  return medial;
}

// The least feature size at boundary cells within each cell of twice the size.
CellArray<float> least_feature_sizes(const Distances& boundary, const Distances& medial) {
  const Index3 size{boundary.size[0] / 2, boundary.size[1] / 2, boundary.size[2] / 2};
  CellArray<float> least(size, kAnySize);
#pragma omp parallel for schedule(static)
  for (int k = 0; k < boundary.size[2]; ++k) {
    if (k % 2 != 0) continue;
    for (int z = k; z < k + 2; ++z) {
      for (int j = 0; j < boundary.size[1]; ++j) {
        for (int i = 0; i < boundary.size[0]; ++i) {
          if (boundary.at(i, j, z) != 0) continue;
          float& value = least.at(i / 2, j / 2, k / 2);
          value = std::min(value, static_cast<float>(distance_at(medial, i, j, z)));
        }
      }
    }
  }
  return least;
}

// A step to a neighbour that a sweep in the order of cells comes to earlier, and what a size may grow on it.
struct Step {
  int i, j, k;
  float rise;
};

std::vector<Step> steps_to_earlier_neighbours(double lipschitz) {
  std::vector<Step> steps;
  for (int k = -1; k <= 0; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const bool earlier = k < 0 || (k == 0 && (j < 0 || (j == 0 && i < 0)));
        const double length = 2 * std::sqrt(static_cast<double>(i * i + j * j + k * k));
        if (earlier) steps.push_back({i, j, k, static_cast<float>(lipschitz * length)});
      }
    }
  }
  return steps;
}

// Lets sizes grow from cell to cell by no more than the Lipschitz constant: two sweeps of a chamfer
// transform.
void limit_growth(CellArray<float>& sizes, double lipschitz) {
  const std::vector<Step> earlier = steps_to_earlier_neighbours(lipschitz);
  const auto relax = [&](int i, int j, int k, int sign) {
    float value = sizes.at(i, j, k);
    for (const Step& s : earlier) {
      const int x = i + sign * s.i, y = j + sign * s.j, z = k + sign * s.k;
      if (sizes.contains(x, y, z)) value = std::min(value, sizes.at(x, y, z) + s.rise);
    }
    sizes.at(i, j, k) = value;
  };
  for (int k = 0; k < sizes.size[2]; ++k) {
    for (int j = 0; j < sizes.size[1]; ++j) {
      for (int i = 0; i < sizes.size[0]; ++i) relax(i, j, k, 1);
    }
  }
  for (int k = sizes.size[2] - 1; k >= 0; --k) {
    for (int j = sizes.size[1] - 1; j >= 0; --j) {
      for (int i = sizes.size[0] - 1; i >= 0; --i) relax(i, j, k, -1);
    }
  }
}

}  // namespace

CellArray<MaterialId> materials_of_cells(const LatticeGrid& grid, const ImageIndicators& indicators) {
  CellArray<MaterialId> materials(grid.cells_of_level(grid.usual_level), kBackground);
  const double edge = 1 << grid.usual_level;
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < materials.size[2]; ++k) {
    for (int j = 0; j < materials.size[1]; ++j) {
      for (int i = 0; i < materials.size[0]; ++i) {
        materials.at(i, j, k) =
            indicators.material_at(grid.place((i + 0.5) * edge, (j + 0.5) * edge, (k + 0.5) * edge));
      }
    }
  }
  return materials;
}

CellArray<float> sizing_field(const CellArray<MaterialId>& materials, const SizingOptions& options) {
  const Distances boundary = boundary_distances(materials);
  CellArray<float> sizes = least_feature_sizes(boundary, medial_distances(boundary));
  limit_growth(sizes, kGrowthFactor * options.lipschitz);
  for (float& size : sizes.values) size *= static_cast<float>(kFeatureFactor * options.feature_scaling);
  return sizes;
}

}  // namespace cbc3d::baselines::cleaver
