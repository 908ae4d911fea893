#include "metrics/mesh_raster.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "mesher/core/voxel_rows.hpp"
#include "metrics/box_tree.hpp"
#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kRelativeTolerance = 1e-9;  // of a tet's volume
constexpr std::uint32_t kNotWanted = ~std::uint32_t{0};

// A tet that voxel centres are located in.
class LocatedTet {
 public:
  LocatedTet(const std::array<VertexId, 4>& nodes, const std::vector<Vec3>& points)
      : p_{points[nodes[0]], points[nodes[1]], points[nodes[2]], points[nodes[3]]},
        volume_(six_volumes(p_[0], p_[1], p_[2], p_[3])) {}

  [[nodiscard]] Box box() const {
    Box box;
    for (const Vec3& p : p_) {
      box.add(p);
    }
    return box;
  }
  /// The smallest barycentric coordinate of a point; negative outside, minus infinity or NaN of a flat tet.
  [[nodiscard]] double depth(const Vec3& q) const {
    const double a = six_volumes(q, p_[1], p_[2], p_[3]), b = six_volumes(p_[0], q, p_[2], p_[3]);
    const double c = six_volumes(p_[0], p_[1], q, p_[3]), d = six_volumes(p_[0], p_[1], p_[2], q);
    return std::min({a / volume_, b / volume_, c / volume_, d / volume_});
  }

 private:
  std::array<Vec3, 4> p_;
  double volume_;
};

// Calls visit(offset) for the voxel centres within a tet or on its border.
template <class Visit>
void for_centres_in(const LocatedTet& tet, const ImageFrame& frame, const Visit& visit) {
  const Box box = tet.box();
  Index3 low{}, high{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    const double last = frame.size[n] - 1.0;
    low[n] = static_cast<int>(
        std::ceil(std::clamp(box.low[axis] / frame.spacing_mm[axis] - kRelativeTolerance, 0.0, last + 1)));
    high[n] = static_cast<int>(
        std::floor(std::clamp(box.high[axis] / frame.spacing_mm[axis] + kRelativeTolerance, -1.0, last)));
  }
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        if (tet.depth(frame.local_centre(i, j, k)) >= -kRelativeTolerance) {
          visit(frame.offset(i, j, k));
        }
      }
    }
  }
}

using Bits = std::vector<std::uint64_t>;

bool has_bit(const Bits& bits, std::size_t n) {
  return (bits[n / 64] >> (n % 64) & 1U) != 0;
}

// Marks the voxels whose own label holds them, and finds those that another holds: pairs of wanted label and
// voxel.
std::vector<std::pair<std::uint32_t, std::size_t>> cover(const MeshView& view, const LabelImage& image,
                                                         const std::vector<RasterLabel>& labels,
                                                         const std::vector<std::uint32_t>& wanted,
                                                         Bits& agreed) {
  std::vector<std::pair<std::uint32_t, std::size_t>> overfilled;
#pragma omp parallel if (view.cell_count() > kWorthThreads)
  {
    std::vector<std::pair<std::uint32_t, std::size_t>> mine;
#pragma omp for schedule(dynamic, 1024) nowait
    for (std::size_t c = 0; c < view.cell_count(); ++c) {
      const std::uint32_t n = wanted[view.label_index(c)];
      if (n == kNotWanted) {
        continue;
      }
      const TetSplit split = split_into_tets(view.cell(c));
      for (int t = 0; t < split.count; ++t) {
        const LocatedTet tet(split.tets[static_cast<std::size_t>(t)], view.local_points());
        for_centres_in(tet, image.frame, [&](std::size_t voxel) {
          if (image.voxels[voxel] == labels[n].material) {
            std::atomic_ref(agreed[voxel / 64])
                .fetch_or(std::uint64_t{1} << (voxel % 64), std::memory_order_relaxed);
          } else {
            mine.emplace_back(n, voxel);
          }
        });
      }
    }
#pragma omp critical(cbc3d_overfilled)
    overfilled.insert(overfilled.end(), mine.begin(), mine.end());
  }
  std::sort(overfilled.begin(), overfilled.end());
  overfilled.erase(std::unique(overfilled.begin(), overfilled.end()), overfilled.end());
  return overfilled;
}

}  // namespace

std::vector<RelabelledVoxels> relabelled_voxels(const MeshView& view, const LabelImage& image,
                                                const std::vector<RasterLabel>& labels) {
  std::vector<std::uint32_t> wanted(view.labels().size(), kNotWanted);
  std::vector<std::uint32_t> of_material(image.material_count(), kNotWanted);
  for (std::uint32_t n = 0; n < labels.size(); ++n) {
    wanted[labels[n].mesh_label] = n;
    of_material[labels[n].material] = n;
  }
  std::vector<RelabelledVoxels> result(labels.size());
  Bits agreed((image.voxels.size() + 63) / 64, 0);
  for (const auto& [n, voxel] : cover(view, image, labels, wanted, agreed)) {
    if (!has_bit(agreed, voxel)) {
      result[n].overfilled.push_back(voxel);
    }
  }
  image.voxels.visit([&](const auto* voxels) {
    const auto size = static_cast<std::size_t>(image.frame.size[0]);
    for (std::size_t row = 0; row < image.voxels.size(); row += size) {
      for (int i = 0, end = 0; i < image.frame.size[0]; i = end) {
        end = end_of_run(voxels + row, i, image.frame.size[0]);
        const std::uint32_t n = of_material[voxels[row + static_cast<std::size_t>(i)]];
        for (int at = i; n != kNotWanted && at < end; ++at) {
          const std::size_t voxel = row + static_cast<std::size_t>(at);
          if (!has_bit(agreed, voxel)) {
            result[n].uncovered.push_back(voxel);
          }
        }
      }
    }
  });
  return result;
}

}  // namespace cbc3d::metrics
