#include "metrics/voxel_components.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/core/disjoint_sets.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d::metrics {
namespace {

// The number nearest to `wanted` within [begin, end).
int nearest_in(int begin, int end, double wanted) {
  return std::clamp(static_cast<int>(std::lround(wanted)), begin, end - 1);
}

}  // namespace

std::vector<VoxelBox> boxes_of_materials(const LabelImage& image) {
  const Index3& size = image.frame.size;
  std::vector<VoxelBox> boxes(image.material_count());
  for (VoxelBox& box : boxes) {
    box.low.fill(std::numeric_limits<int>::max());
  }
  image.voxels.visit([&](const auto* voxels) {
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        const auto* row = voxels + image.frame.offset(0, j, k);
        for (int i = 0, end = 0; i < size[0]; i = end) {
          end = end_of_run(row, i, size[0]);
          VoxelBox& box = boxes[row[i]];
          box.low = {std::min(box.low[0], i), std::min(box.low[1], j), std::min(box.low[2], k)};
          box.high = {std::max(box.high[0], end - 1), std::max(box.high[1], j), std::max(box.high[2], k)};
        }
      }
    }
  });
  return boxes;
}

VoxelComponents::VoxelComponents(const LabelImage& image, const Set& set, const VoxelBox& box) : box_(box) {
  find_runs(image, set);
  join_runs(set.joins_at_corners);
  describe();
}

std::size_t VoxelComponents::row(int j, int k) const {
  const int rows = box_.high[1] - box_.low[1] + 1;
  return static_cast<std::size_t>(k - box_.low[2]) * static_cast<std::size_t>(rows) +
         static_cast<std::size_t>(j - box_.low[1]);
}

void VoxelComponents::find_runs(const LabelImage& image, const Set& set) {
  const auto is_in = [&](int i, int j, int k) {
    const bool of_material =
        image.frame.contains(i, j, k) && image.voxels[image.frame.offset(i, j, k)] == set.material;
    return of_material != set.complement;
  };
  first_.push_back(0);
  for (int k = box_.low[2]; k <= box_.high[2]; ++k) {
    for (int j = box_.low[1]; j <= box_.high[1]; ++j) {
      bool inside = false;
      for (int i = box_.low[0]; i <= box_.high[0]; ++i) {
        const bool in = is_in(i, j, k);
        if (in && !inside) {
          runs_.push_back({i, i + 1});
        } else if (in) {
          runs_.back().end = i + 1;
        }
        inside = in;
      }
      first_.push_back(runs_.size());
    }
  }
}

void VoxelComponents::join_runs(bool at_corners) {
  DisjointSets sets(runs_.size());
  const int reach = at_corners ? 1 : 0;
  const auto join_rows = [&](std::size_t one, std::size_t other) {
    std::size_t b = first_[other];
    for (std::size_t a = first_[one]; a < first_[one + 1]; ++a) {
      while (b < first_[other + 1] && runs_[b].end + reach <= runs_[a].begin) {
        ++b;
      }
      for (std::size_t c = b; c < first_[other + 1] && runs_[c].begin < runs_[a].end + reach; ++c) {
        sets.join(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(c));
      }
    }
  };
  for (int k = box_.low[2]; k <= box_.high[2]; ++k) {
    for (int j = box_.low[1]; j <= box_.high[1]; ++j) {
      for (int dk = -1; dk <= 0; ++dk) {
        for (int dj = -1; dj <= 1; ++dj) {
          const bool before = dk < 0 || dj < 0, at_face = dk == 0 || dj == 0;
          const bool in_box = k + dk >= box_.low[2] && j + dj >= box_.low[1] && j + dj <= box_.high[1];
          if (before && in_box && (at_face || at_corners)) {
            join_rows(row(j, k), row(j + dj, k + dk));
          }
        }
      }
    }
  }
  component_.resize(runs_.size());
  for (std::uint32_t run = 0; run < runs_.size(); ++run) {
    const std::uint32_t root = sets.root(run);
    if (root == run) {
      component_[run] = static_cast<std::uint32_t>(components_.size());
      components_.emplace_back();
    } else {
      component_[run] = component_[root];
    }
  }
}

void VoxelComponents::describe() {
  std::vector<Vec3> sums(components_.size());
  const auto for_each_run = [this](const auto& visit) {
    for (int k = box_.low[2]; k <= box_.high[2]; ++k) {
      for (int j = box_.low[1]; j <= box_.high[1]; ++j) {
        const bool at_border = j == box_.low[1] || j == box_.high[1] || k == box_.low[2] || k == box_.high[2];
        for (std::size_t r = first_[row(j, k)]; r < first_[row(j, k) + 1]; ++r) {
          visit(component_[r], runs_[r], j, k, at_border);
        }
      }
    }
  };
  for_each_run([&](std::uint32_t c, const Run& run, int j, int k, bool at_border) {
    const double length = run.end - run.begin;
    components_[c].voxels += run.end - run.begin;
    components_[c].reaches_border |= at_border || run.begin == box_.low[0] || run.end == box_.high[0] + 1;
    sums[c] += length * Vec3{0.5 * (run.begin + run.end - 1), double(j), double(k)};
  });
  std::vector<double> nearest(components_.size(), std::numeric_limits<double>::infinity());
  for_each_run([&](std::uint32_t c, const Run& run, int j, int k, bool) {
    const Vec3 centroid = sums[c] / static_cast<double>(components_[c].voxels);
    const int i = nearest_in(run.begin, run.end, centroid.x);
    const double squared = (Vec3{double(i), double(j), double(k)} - centroid).squared_norm();
    if (squared < nearest[c]) {
      nearest[c] = squared;
      components_[c].place = {i, j, k};
    }
  });
}

std::optional<std::uint32_t> VoxelComponents::find(const Index3& voxel) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (voxel[axis] < box_.low[axis] || voxel[axis] > box_.high[axis]) {
      return std::nullopt;
    }
  }
  const std::size_t r = row(voxel[1], voxel[2]);
  const auto end = runs_.begin() + static_cast<std::ptrdiff_t>(first_[r + 1]);
  const auto found = std::partition_point(runs_.begin() + static_cast<std::ptrdiff_t>(first_[r]), end,
                                          [&](const Run& run) { return run.end <= voxel[0]; });
  if (found == end || found->begin > voxel[0]) {
    return std::nullopt;
  }
  return component_[static_cast<std::size_t>(found - runs_.begin())];
}

}  // namespace cbc3d::metrics
