#include "metrics/image_topology.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "mesher/core/disjoint_sets.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d::metrics {
namespace {

struct CornerSums {
  std::int64_t closed = 0, open = 0, ambiguous = 0;  // the first two times eight

  void add(const CornerTables& tables, unsigned mask) {
    closed += tables.closed[mask];
    open += tables.open[mask];
    ambiguous += tables.closed[mask] != tables.open[mask] ? 1 : 0;
  }
};

// One entry a material, one more for all of them as one.
using AllCornerSums = std::vector<CornerSums>;

void add_corner(const std::array<MaterialId, 8>& voxels, const CornerTables& tables, AllCornerSums& sums) {
  unsigned labelled = 0, left = 0;
  for (unsigned n = 0; n < 8; ++n) {
    labelled |= voxels[n] != kBackground ? 1U << n : 0U;
  }
  sums.back().add(tables, labelled);
  for (left = labelled; left != 0;) {
    unsigned first = 0;
    while ((left >> first & 1U) == 0) {
      ++first;
    }
    unsigned mask = 0;
    for (unsigned n = first; n < 8; ++n) {
      mask |= voxels[n] == voxels[first] ? 1U << n : 0U;
    }
    sums[voxels[first]].add(tables, mask);
    left &= ~mask;
  }
}

// The first index from i on, in steps of eight bytes, from where on not all voxels of four rows are `value`.
template <typename Voxel>
int end_of_uniform(const std::array<const Voxel*, 4>& rows, int i, int size, Voxel value) {
  const std::uint64_t uniform = value * (~std::uint64_t{0} / static_cast<Voxel>(~Voxel{0}));
  while (i + kVoxelsInWord<Voxel> <= size &&
         ((voxel_word(rows[0] + i) ^ uniform) | (voxel_word(rows[1] + i) ^ uniform) |
          (voxel_word(rows[2] + i) ^ uniform) | (voxel_word(rows[3] + i) ^ uniform)) == 0) {
    i += kVoxelsInWord<Voxel>;
  }
  return i;
}

// Corners between the four rows (j, k), (j + 1, k), (j, k + 1), (j + 1, k + 1), padded with background.
template <typename Voxel>
void add_row_of_corners(const ImageFrame& frame, const Voxel* voxels, int j, int k, const Voxel* none,
                        const CornerTables& tables, AllCornerSums& sums) {
  std::array<const Voxel*, 4> rows;
  for (int n = 0; n < 4; ++n) {
    const int row_j = j + n % 2, row_k = k + n / 2;
    rows[static_cast<std::size_t>(n)] =
        frame.contains(0, row_j, row_k) ? voxels + frame.offset(0, row_j, row_k) : none;
  }
  std::array<MaterialId, 4> before{};
  bool before_uniform = true;
  for (int i = 0; i <= frame.size[0]; ++i) {
    i = before_uniform ? end_of_uniform(rows, i, frame.size[0], static_cast<Voxel>(before[0])) : i;
    std::array<MaterialId, 4> here{};
    if (i < frame.size[0]) {
      here = {rows[0][i], rows[1][i], rows[2][i], rows[3][i]};
    }
    const bool uniform = here[0] == here[1] && here[0] == here[2] && here[0] == here[3];
    if (!(uniform && before_uniform && here[0] == before[0])) {
      add_corner({before[0], here[0], before[1], here[1], before[2], here[2], before[3], here[3]}, tables,
                 sums);
    }
    before = here;
    before_uniform = uniform;
  }
}

AllCornerSums corner_sums(const LabelImage& image) {
  const CornerTables tables = corner_tables();
  AllCornerSums total(image.material_count() + 1);
  image.voxels.visit([&]<typename Voxel>(const Voxel* voxels) {
    const std::vector<Voxel> none(static_cast<std::size_t>(image.frame.size[0]), kBackground);
#pragma omp parallel
    {
      AllCornerSums mine(total.size());
#pragma omp for nowait schedule(dynamic)
      for (int k = -1; k < image.frame.size[2]; ++k) {
        for (int j = -1; j < image.frame.size[1]; ++j) {
          add_row_of_corners(image.frame, voxels, j, k, none.data(), tables, mine);
        }
      }
#pragma omp critical(cbc3d_corner_sums)
      for (std::size_t m = 0; m < total.size(); ++m) {
        total[m].closed += mine[m].closed;
        total[m].open += mine[m].open;
        total[m].ambiguous += mine[m].ambiguous;
      }
    }
  });
  return total;
}

// Equal voxels in a row, from `begin` to the next run's.
struct Run {
  std::int32_t begin;
  MaterialId material;
};

using RegionPair = std::pair<std::uint32_t, std::uint32_t>;

// The 6-connected regions of equal voxels, the outside of the image among them, and which of them touch.
class Regions {
 public:
  explicit Regions(const LabelImage& image) : image_(image) {
    find_runs();
    join_runs();
    find_pairs();
  }
  [[nodiscard]] const std::vector<MaterialId>& materials() const { return materials_; }
  [[nodiscard]] const std::vector<RegionPair>& at_faces() const { return at_faces_; }
  /// Also those that share an edge or a corner alone, equal materials too.
  [[nodiscard]] const std::vector<RegionPair>& at_corners() const { return at_corners_; }

 private:
  [[nodiscard]] std::size_t row(int j, int k) const {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(image_.frame.size[1]) +
           static_cast<std::size_t>(j);
  }

  void find_runs() {
    const Index3& size = image_.frame.size;
    first_.push_back(0);
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        image_.voxels.visit([&](const auto* voxels) {
          const auto* row = voxels + image_.frame.offset(0, j, k);
          for (int i = 0; i < size[0]; i = end_of_run(row, i, size[0])) {
            runs_.push_back({i, row[i]});
          }
        });
        if (runs_.size() >= std::numeric_limits<std::uint32_t>::max()) {
          throw JobError(
              "the image has more runs of equal voxels than can be numbered; remove its noise first");
        }
        first_.push_back(static_cast<std::uint32_t>(runs_.size()));
      }
    }
  }

  // Calls visit(a, b) for the runs of two rows that overlap, or with `reach` 1 that come within one voxel.
  template <class Visit>
  void for_overlaps(std::size_t row_a, std::size_t row_b, int reach, const Visit& visit) const {
    const auto end_of = [this](std::uint32_t run, std::size_t of_row) {
      return run + 1 < first_[of_row + 1] ? runs_[run + 1].begin : image_.frame.size[0];
    };
    std::uint32_t b = first_[row_b];
    for (std::uint32_t a = first_[row_a]; a < first_[row_a + 1]; ++a) {
      const int begin = runs_[a].begin - reach, end = end_of(a, row_a) + reach;
      while (end_of(b, row_b) <= begin) {
        ++b;
      }
      for (std::uint32_t other = b; other < first_[row_b + 1] && runs_[other].begin < end; ++other) {
        visit(a, other);
      }
    }
  }

  // Calls visit(run) for every run with a voxel at the border of the image.
  template <class Visit>
  void for_border_runs(const Visit& visit) const {
    const Index3& size = image_.frame.size;
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        const std::size_t r = row(j, k);
        const bool whole_row = j == 0 || k == 0 || j == size[1] - 1 || k == size[2] - 1;
        for (std::uint32_t run = first_[r]; run < first_[r + 1]; ++run) {
          if (whole_row || run == first_[r] || run + 1 == first_[r + 1]) {
            visit(run);
          }
        }
      }
    }
  }

  void join_runs() {
    const auto outside = static_cast<std::uint32_t>(runs_.size());
    DisjointSets sets(runs_.size() + 1);
    const auto join_equal = [&](std::uint32_t a, std::uint32_t b) {
      if (runs_[a].material == runs_[b].material) {
        sets.join(a, b);
      }
    };
    for (int k = 0; k < image_.frame.size[2]; ++k) {
      for (int j = 0; j < image_.frame.size[1]; ++j) {
        if (j > 0) {
          for_overlaps(row(j, k), row(j - 1, k), 0, join_equal);
        }
        if (k > 0) {
          for_overlaps(row(j, k), row(j, k - 1), 0, join_equal);
        }
      }
    }
    for_border_runs([&](std::uint32_t run) {
      if (runs_[run].material == kBackground) {
        sets.join(run, outside);
      }
    });
    region_.resize(sets.size());
    for (std::uint32_t run = 0; run < sets.size(); ++run) {
      const std::uint32_t root = sets.root(run);
      if (root == run) {
        region_[run] = static_cast<std::uint32_t>(materials_.size());
        materials_.push_back(run == outside ? kBackground : runs_[run].material);
      } else {
        region_[run] = region_[root];
      }
    }
  }

  void find_pairs() {
    const auto outside = static_cast<std::uint32_t>(runs_.size());
    for (int k = 0; k < image_.frame.size[2]; ++k) {
      for (int j = 0; j < image_.frame.size[1]; ++j) {
        const std::size_t here = row(j, k);
        for (std::uint32_t run = first_[here] + 1; run < first_[here + 1]; ++run) {
          add(run - 1, run, at_faces_);
        }
        find_pairs_with_row(here, j - 1, k, true);
        find_pairs_with_row(here, j, k - 1, true);
        find_pairs_with_row(here, j - 1, k - 1, false);
        find_pairs_with_row(here, j + 1, k - 1, false);
      }
    }
    for_border_runs([&](std::uint32_t run) { add(run, outside, at_faces_); });
    make_distinct(at_faces_);
    at_corners_.insert(at_corners_.end(), at_faces_.begin(), at_faces_.end());
    make_distinct(at_corners_);
  }

  void find_pairs_with_row(std::size_t here, int j, int k, bool faces) {
    if (!image_.frame.contains(0, j, k)) {
      return;
    }
    if (faces) {
      for_overlaps(here, row(j, k), 0, [&](std::uint32_t a, std::uint32_t b) { add(a, b, at_faces_); });
    }
    for_overlaps(here, row(j, k), 1, [&](std::uint32_t a, std::uint32_t b) { add(a, b, at_corners_); });
  }

  void add(std::uint32_t run_a, std::uint32_t run_b, std::vector<RegionPair>& pairs) {
    const RegionPair pair = std::minmax(region_[run_a], region_[run_b]);
    if (pair.first == pair.second) {
      return;
    }
    // Most pairs were met just before; what slips through is dropped at the end.
    auto& recent = &pairs == &at_faces_ ? recent_faces_ : recent_corners_;
    RegionPair& slot = recent[(31 * std::size_t{pair.first} + pair.second) % recent.size()];
    if (slot != pair) {
      pairs.push_back(pair);
      slot = pair;
    }
  }

  static void make_distinct(std::vector<RegionPair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  }

  const LabelImage& image_;
  std::vector<Run> runs_;
  std::vector<std::uint32_t> first_;   // run of every row, and the end
  std::vector<std::uint32_t> region_;  // of every run, then of the outside
  std::vector<MaterialId> materials_;  // of every region
  std::vector<RegionPair> at_faces_, at_corners_;
  std::array<RegionPair, 1024> recent_faces_{}, recent_corners_{};
};

// Number of parts of the regions that `in` accepts, joined by the pairs.
template <class In>
std::int64_t count_parts(const Regions& regions, const std::vector<RegionPair>& pairs, const In& in) {
  DisjointSets sets(regions.materials().size());
  for (const auto& [a, b] : pairs) {
    if (in(regions.materials()[a]) && in(regions.materials()[b])) {
      sets.join(a, b);
    }
  }
  std::int64_t parts = 0;
  for (std::uint32_t r = 0; r < sets.size(); ++r) {
    parts += in(regions.materials()[r]) && sets.root(r) == r ? 1 : 0;
  }
  return parts;
}

Betti betti_of(std::int64_t parts, std::int64_t complement_parts, std::int64_t eight_euler) {
  const std::int64_t cavities = complement_parts - 1;
  return {{parts, parts + cavities - eight_euler / 8, cavities}};
}

template <class In>
VoxelSetTopology set_topology(const Regions& regions, const CornerSums& sums, const In& in) {
  const auto out = [&in](MaterialId m) { return !in(m); };
  return {betti_of(count_parts(regions, regions.at_corners(), in),
                   count_parts(regions, regions.at_faces(), out), sums.closed),
          betti_of(count_parts(regions, regions.at_faces(), in),
                   count_parts(regions, regions.at_corners(), out), sums.open),
          sums.ambiguous};
}

}  // namespace

CornerTables corner_tables() {
  CornerTables tables{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    const auto in = [mask](unsigned x, unsigned y, unsigned z) {
      return (mask >> (x + 2 * y + 4 * z) & 1U) != 0;
    };
    const auto at = [&in](unsigned axis, unsigned a, unsigned u, unsigned v) {
      return axis == 0 ? in(a, u, v) : axis == 1 ? in(u, a, v) : in(u, v, a);
    };
    int voxels = 0, any_edges = 0, all_edges = 0, any_faces = 0, all_faces = 0;
    for (unsigned voxel = 0; voxel < 8; ++voxel) {
      voxels += static_cast<int>(mask >> voxel & 1U);
    }
    for (unsigned axis = 0; axis < 3; ++axis) {
      for (unsigned side = 0; side < 2; ++side) {
        const int count =
            at(axis, side, 0, 0) + at(axis, side, 0, 1) + at(axis, side, 1, 0) + at(axis, side, 1, 1);
        any_edges += count > 0 ? 1 : 0;
        all_edges += count == 4 ? 1 : 0;
      }
      for (unsigned quarter = 0; quarter < 4; ++quarter) {
        const int count = at(axis, 0, quarter & 1U, quarter >> 1U) + at(axis, 1, quarter & 1U, quarter >> 1U);
        any_faces += count > 0 ? 1 : 0;
        all_faces += count == 2 ? 1 : 0;
      }
    }
    tables.closed[mask] = (mask != 0 ? 8 : 0) - 4 * any_edges + 2 * any_faces - voxels;
    tables.open[mask] = voxels - 2 * all_faces + 4 * all_edges - (mask == 255 ? 8 : 0);
  }
  return tables;
}

ImageTopology image_topology(const LabelImage& image) {
  const AllCornerSums sums = corner_sums(image);
  const Regions regions(image);
  ImageTopology result;
  result.per_material.resize(image.material_count() <= kMostLabelsWithTopology + 1 ? image.material_count()
                                                                                   : 0);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t m = 1; m < result.per_material.size(); ++m) {
    result.per_material[m] =
        set_topology(regions, sums[m], [m](MaterialId material) { return material == m; });
  }
  result.all =
      set_topology(regions, sums.back(), [](MaterialId material) { return material != kBackground; });
  return result;
}

const VoxelSetTopology* find_label(const ImageTopology& topology, const LabelImage& image, Label label) {
  const auto first = image.labels.begin() + 1;
  const auto found = std::lower_bound(first, image.labels.end(), label);
  if (topology.per_material.empty() || found == image.labels.end() || *found != label) {
    return nullptr;
  }
  return &topology.per_material[static_cast<std::size_t>(found - image.labels.begin())];
}

}  // namespace cbc3d::metrics
