#include "mesher/preprocess/voxel_noise.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {
namespace {

struct Neighbourhood {
  std::array<MaterialId, 26> materials;
  std::array<bool, 26> by_face;
};

Neighbourhood neighbourhood_of(const LabelImage& image, int i, int j, int k) {
  Neighbourhood around{};
  std::size_t n = 0;
  for (int dk = -1; dk <= 1; ++dk) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        if (di != 0 || dj != 0 || dk != 0) {
          around.materials[n] = image.at_or_background(i + di, j + dj, k + dk);
          around.by_face[n] = std::abs(di) + std::abs(dj) + std::abs(dk) == 1;
          ++n;
        }
      }
    }
  }
  return around;
}

MaterialId most_frequent(const Neighbourhood& around) {
  MaterialId best = around.materials[0];
  int best_votes = -1;
  for (const MaterialId candidate : around.materials) {
    int votes = 0;
    for (std::size_t n = 0; n < 26; ++n) {
      votes += around.materials[n] == candidate ? 32 + static_cast<int>(around.by_face[n]) : 0;
    }
    if (votes > best_votes || (votes == best_votes && candidate < best)) {
      best = candidate;
      best_votes = votes;
    }
  }
  return best;
}

bool is_noisy(const LabelImage& image, int i, int j, int k, NoisyVoxels which) {
  const MaterialId own = image.at(i, j, k);
  if (own == kBackground ? which == NoisyVoxels::specks : which == NoisyVoxels::holes) {
    return false;
  }
  // The six face neighbours decide nearly every voxel.
  if (image.at_or_background(i - 1, j, k) == own || image.at_or_background(i + 1, j, k) == own) {
    return false;
  }
  const Neighbourhood around = neighbourhood_of(image, i, j, k);
  return std::find(around.materials.begin(), around.materials.end(), own) == around.materials.end();
}

struct Change {
  std::size_t voxel;
  MaterialId material;
};

std::vector<Change> changes_of_slice(const LabelImage& image, int k, NoisyVoxels which) {
  std::vector<Change> changes;
  image.voxels.visit([&](const auto* voxels) {
    for (int j = 0; j < image.frame.size[1]; ++j) {
      const auto* row = voxels + image.frame.offset(0, j, k);
      for (int i = 0, end = 0; i < image.frame.size[0]; i = end) {
        end = end_of_run(row, i, image.frame.size[0]);
        if (end == i + 1 && is_noisy(image, i, j, k, which)) {  // those in a longer run are not
          changes.push_back({image.frame.offset(i, j, k), most_frequent(neighbourhood_of(image, i, j, k))});
        }
      }
    }
  });
  return changes;
}

}  // namespace

NoiseReport relabel_noisy_voxels(LabelImage& image, NoisyVoxels which) {
  NoiseReport report;
  if (which == NoisyVoxels::none) {
    return report;
  }
  std::vector<std::vector<Change>> changes(static_cast<std::size_t>(image.frame.size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < image.frame.size[2]; ++k) {
    changes[static_cast<std::size_t>(k)] = changes_of_slice(image, k, which);
  }
  for (const auto& slice : changes) {
    for (const Change& change : slice) {
      ++(image.voxels[change.voxel] == kBackground ? report.holes_filled : report.specks_relabelled);
      image.voxels.set(change.voxel, change.material);
    }
  }
  return report;
}

}  // namespace cbc3d
