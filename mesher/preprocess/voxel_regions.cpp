#include "mesher/preprocess/voxel_regions.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {
namespace {

/// Voxels [begin, end) of one row with one labelled material.
struct Run {
  std::int32_t begin, end;
  MaterialId material;
};

/// The labelled runs of the image, row by row, and the region that each belongs to.
class Regions {
 public:
  explicit Regions(const LabelImage& image) : image_(image) {
    collect_runs();
    parent_.resize(runs_.size());
    std::iota(parent_.begin(), parent_.end(), 0U);
    join();
    number_regions();
  }

  struct Region {
    MaterialId material;
    std::size_t voxels;
  };
  [[nodiscard]] const std::vector<Region>& list() const { return regions_; }

  /// Gives the voxels of every region r the material to[r].
  void assign(const std::vector<MaterialId>& to, LabelVoxels& voxels) const {
    const auto nx = static_cast<std::size_t>(image_.frame.size[0]);
    const std::size_t rows = first_.size() - 1;
    voxels.hold(image_.material_count());
    voxels.visit([&]<typename Voxel>(Voxel* all) {
#pragma omp parallel for schedule(static)
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t r = first_[row]; r < first_[row + 1]; ++r) {
          const MaterialId material = to[parent_[r]];
          if (material != runs_[r].material) {
            Voxel* const begin = all + row * nx;
            std::fill(begin + runs_[r].begin, begin + runs_[r].end, static_cast<Voxel>(material));
          }
        }
      }
    });
  }

 private:
  /// Slice by slice in parallel, the image read once.
  void collect_runs() {
    const auto ny = static_cast<std::size_t>(image_.frame.size[1]);
    const auto nz = static_cast<std::size_t>(image_.frame.size[2]);
    std::vector<std::vector<Run>> slices(nz);
    first_.assign(ny * nz + 1, 0);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < nz; ++k) {
      for (std::size_t row = k * ny; row < (k + 1) * ny; ++row) {
        const std::size_t before = slices[k].size();
        for_each_run(row, [&](const Run& run) { slices[k].push_back(run); });
        first_[row + 1] = slices[k].size() - before;
      }
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    if (first_.back() > std::numeric_limits<std::uint32_t>::max()) {
      throw JobError("the image has " + std::to_string(first_.back()) +
                     " runs of equal voxels, more than can be numbered; remove its noise first");
    }
    runs_.reserve(first_.back());
    for (std::vector<Run>& slice : slices) {
      runs_.insert(runs_.end(), slice.begin(), slice.end());
      slice = {};
    }
  }

  template <typename Action>
  void for_each_run(std::size_t row, const Action& action) const {
    const std::int32_t nx = image_.frame.size[0];
    image_.voxels.visit([&](const auto* all) {
      const auto* voxels = all + row * static_cast<std::size_t>(nx);
      for (std::int32_t i = 0; i < nx;) {
        const std::int32_t end = end_of_run(voxels, i, nx);
        if (voxels[i] != kBackground) {
          action(Run{i, end, voxels[i]});
        }
        i = end;
      }
    });
  }

  std::uint32_t root(std::uint32_t r) {
    while (parent_[r] != r) {
      parent_[r] = parent_[parent_[r]];
      r = parent_[r];
    }
    return r;
  }

  /// Blocks of slices in parallel, which share no run, and then each with the one before. The root of what is
  /// joined is its first run, in whatever order it was.
  void join() {
    constexpr std::size_t kSlicesOfBlock = 16;
    const auto ny = static_cast<std::size_t>(image_.frame.size[1]);
    const auto nz = static_cast<std::size_t>(image_.frame.size[2]);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t begin = 0; begin < nz; begin += kSlicesOfBlock) {
      for (std::size_t row = begin * ny; row < std::min(nz, begin + kSlicesOfBlock) * ny; ++row) {
        if (row % ny != 0) {
          join_rows(row - 1, row);
        }
        if (row >= (begin + 1) * ny) {
          join_rows(row - ny, row);
        }
      }
    }
    for (std::size_t k = kSlicesOfBlock; k < nz; k += kSlicesOfBlock) {
      for (std::size_t row = k * ny; row < (k + 1) * ny; ++row) {
        join_rows(row - ny, row);
      }
    }
  }

  /// Joins overlapping runs of the same material of two neighbouring rows; the earlier run stays the root.
  void join_rows(std::size_t a, std::size_t b) {
    std::size_t p = first_[a];
    for (std::size_t q = first_[b]; q < first_[b + 1]; ++q) {
      while (p < first_[a + 1] && runs_[p].end <= runs_[q].begin) {
        ++p;
      }
      for (std::size_t s = p; s < first_[a + 1] && runs_[s].begin < runs_[q].end; ++s) {
        if (runs_[s].material == runs_[q].material) {
          const std::uint32_t u = root(static_cast<std::uint32_t>(s));
          const std::uint32_t v = root(static_cast<std::uint32_t>(q));
          parent_[std::max(u, v)] = std::min(u, v);
        }
      }
    }
  }

  /// Regions are numbered by their first run; parent_ becomes the region of each run.
  void number_regions() {
    std::vector<std::uint32_t> number(runs_.size());
    for (std::uint32_t r = 0; r < runs_.size(); ++r) {
      const std::uint32_t top = root(r);
      if (top == r) {
        number[r] = static_cast<std::uint32_t>(regions_.size());
        regions_.push_back({runs_[r].material, 0});
      }
      number[r] = number[top];
      regions_[number[r]].voxels += static_cast<std::size_t>(runs_[r].end - runs_[r].begin);
    }
    parent_.swap(number);
  }

  const LabelImage& image_;
  std::vector<std::size_t> first_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> parent_;
  std::vector<Region> regions_;
};

struct MaterialSummary {
  std::size_t voxels = 0;
  std::size_t largest = 0;  // number of the largest region; the first of equals
};

std::vector<MaterialSummary> summarise(const LabelImage& image, const Regions& regions) {
  std::vector<MaterialSummary> summary(image.material_count(), {0, std::numeric_limits<std::size_t>::max()});
  const auto& list = regions.list();
  for (std::size_t r = 0; r < list.size(); ++r) {
    MaterialSummary& of = summary[list[r].material];
    of.voxels += list[r].voxels;
    if (of.largest == std::numeric_limits<std::size_t>::max() || list[r].voxels > list[of.largest].voxels) {
      of.largest = r;
    }
  }
  return summary;
}

std::vector<MaterialId> present_materials(const Regions& regions) {
  std::vector<MaterialId> to;
  for (const auto& region : regions.list()) {
    to.push_back(region.material);
  }
  return to;
}

}  // namespace

RegionReport remove_small_regions(LabelImage& image, double tolerance) {
  const Regions regions(image);
  const std::vector<MaterialSummary> summary = summarise(image, regions);
  std::vector<MaterialId> to = present_materials(regions);
  RegionReport report;
  report.regions = to.size();
  report.voxels_before.assign(summary.size(), 0);
  std::size_t labelled = 0;
  for (std::size_t m = 1; m < summary.size(); ++m) {
    report.voxels_before[m] = summary[m].voxels;
    labelled += summary[m].voxels;
  }
  report.voxels_before[kBackground] = image.voxels.size() - labelled;
  for (std::size_t r = 0; r < to.size(); ++r) {
    const MaterialSummary& of = summary[to[r]];
    const std::size_t voxels = regions.list()[r].voxels;
    if (r != of.largest && static_cast<double>(voxels) < tolerance * static_cast<double>(of.voxels)) {
      to[r] = kBackground;
      ++report.regions_removed;
      report.voxels_removed += voxels;
    }
  }
  regions.assign(to, image.voxels);
  return report;
}

RegionReport split_regions(LabelImage& image) {
  const Regions regions(image);
  const std::vector<MaterialSummary> summary = summarise(image, regions);
  std::vector<MaterialId> to = present_materials(regions);
  RegionReport report;
  report.regions = to.size();
  std::vector<std::size_t> others;
  for (std::size_t r = 0; r < to.size(); ++r) {
    if (r != summary[to[r]].largest) {
      others.push_back(r);
    }
  }
  std::stable_sort(others.begin(), others.end(), [&](std::size_t a, std::size_t b) {
    return regions.list()[a].voxels > regions.list()[b].voxels;
  });
  for (const std::size_t r : others) {
    if (image.labels.size() <= std::numeric_limits<MaterialId>::max()) {
      const Label label = image.labels[to[r]];
      to[r] = static_cast<MaterialId>(image.labels.size());
      image.labels.push_back(label);
      ++report.materials_added;
    }
  }
  regions.assign(to, image.voxels);
  return report;
}

}  // namespace cbc3d
