#include "mesher/stages/size_rank.hpp"

#include <algorithm>
#include <numeric>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {
namespace {

/// Offset of the first voxel of every material; the voxel count where there is none.
std::vector<std::size_t> first_voxels(const LabelImage& image) {
  std::vector<std::size_t> first(image.material_count(), image.voxels.size());
  const auto nx = static_cast<std::size_t>(image.frame.size[0]);
  const std::size_t rows = nx > 0 ? image.voxels.size() / nx : 0;
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel
    {
      std::vector<std::size_t> mine(first.size(), image.voxels.size());
#pragma omp for schedule(static) nowait
      for (std::size_t r = 0; r < rows; ++r) {
        const auto* row = voxels + r * nx;
        for (int i = 0; i < image.frame.size[0]; i = end_of_run(row, i, image.frame.size[0])) {
          mine[row[i]] = std::min(mine[row[i]], r * nx + static_cast<std::size_t>(i));
        }
      }
#pragma omp critical(cbc3d_first_voxels)
      for (std::size_t m = 0; m < first.size(); ++m) {
        first[m] = std::min(first[m], mine[m]);
      }
    }
  });
  return first;
}

}  // namespace

std::vector<std::uint32_t> rank_by_size(const LabelImage& image,
                                        const std::vector<MaterialId>& class_of_material,
                                        BackgroundRank background) {
  const std::vector<std::size_t> voxels_of_material = image.voxels_per_material();
  const std::vector<std::size_t> first_of_material = first_voxels(image);
  const std::size_t classes = 1U + *std::max_element(class_of_material.begin(), class_of_material.end());
  std::vector<std::size_t> voxels(classes, 0);
  std::vector<std::size_t> first(classes, image.voxels.size());
  for (std::size_t m = 0; m < class_of_material.size(); ++m) {
    voxels[class_of_material[m]] += voxels_of_material[m];
    first[class_of_material[m]] = std::min(first[class_of_material[m]], first_of_material[m]);
  }
  std::vector<std::uint32_t> order(classes);
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin() + 1, order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return voxels[a] != voxels[b] ? voxels[a] > voxels[b] : first[a] > first[b];
  });
  std::vector<std::uint32_t> rank(classes);
  for (std::uint32_t place = 1; place < classes; ++place) {
    rank[order[place]] = place;
  }
  rank[0] = background == BackgroundRank::lowest ? 0 : static_cast<std::uint32_t>(classes);
  return rank;
}

std::vector<std::uint32_t> rank_by_size(const LabelImage& image, BackgroundRank background) {
  std::vector<MaterialId> own(image.material_count());
  std::iota(own.begin(), own.end(), MaterialId{0});
  return rank_by_size(image, own, background);
}

}  // namespace cbc3d
