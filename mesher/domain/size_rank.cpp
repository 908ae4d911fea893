#include "mesher/domain/size_rank.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

MaterialVoxels count_materials(const LabelImage& image) {
  const std::size_t materials = image.material_count();
  MaterialVoxels all{std::vector<std::size_t>(materials, 0),
                     std::vector<std::size_t>(materials, image.voxels.size())};
  const auto nx = static_cast<std::size_t>(image.frame.size[0]);
  const std::size_t rows = nx > 0 ? image.voxels.size() / nx : 0;
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel
    {
      MaterialVoxels mine{std::vector<std::size_t>(materials, 0),
                          std::vector<std::size_t>(materials, image.voxels.size())};
#pragma omp for schedule(static) nowait
      for (std::size_t r = 0; r < rows; ++r) {
        const auto* row = voxels + r * nx;
        for (int i = 0; i < image.frame.size[0];) {
          const int end = end_of_run(row, i, image.frame.size[0]);
          mine.count[row[i]] += static_cast<std::size_t>(end - i);
          mine.first[row[i]] = std::min(mine.first[row[i]], r * nx + static_cast<std::size_t>(i));
          i = end;
        }
      }
#pragma omp critical(cbc3d_count_materials)
      for (std::size_t m = 0; m < materials; ++m) {
        all.count[m] += mine.count[m];
        all.first[m] = std::min(all.first[m], mine.first[m]);
      }
    }
  });
  return all;
}

std::vector<std::uint32_t> rank_by_size(const MaterialVoxels& of_material,
                                        const std::vector<MaterialId>& class_of_material,
                                        BackgroundRank background) {
  const std::size_t classes = 1U + *std::max_element(class_of_material.begin(), class_of_material.end());
  std::vector<std::size_t> voxels(classes, 0);
  std::vector<std::size_t> first(classes, std::numeric_limits<std::size_t>::max());
  for (std::size_t m = 0; m < class_of_material.size(); ++m) {
    voxels[class_of_material[m]] += of_material.count[m];
    first[class_of_material[m]] = std::min(first[class_of_material[m]], of_material.first[m]);
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

std::vector<std::uint32_t> rank_by_size(const MaterialVoxels& of_material, BackgroundRank background) {
  std::vector<MaterialId> own(of_material.count.size());
  std::iota(own.begin(), own.end(), MaterialId{0});
  return rank_by_size(of_material, own, background);
}

}  // namespace cbc3d
