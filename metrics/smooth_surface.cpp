#include "metrics/smooth_surface.hpp"

#include <vtkMarchingCubesTriangleCases.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d::metrics {
namespace {

constexpr int kReach = 2;  // voxels, of the Gaussian
constexpr double kKeptSign = 0.05;

// Corners of a cell as the table of cases numbers them, and its edges.
constexpr std::array<Index3, 8> kCorners{
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
constexpr std::array<std::array<std::size_t, 2>, 12> kEdges{
    {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {3, 7}, {2, 6}}};

std::array<double, 2 * kReach + 1> gaussian() {
  std::array<double, 2 * kReach + 1> weight{};
  double sum = 0;
  for (std::size_t n = 0; n < weight.size(); ++n) {
    const int offset = static_cast<int>(n) - kReach;
    sum += weight[n] = std::exp(-0.5 * offset * offset);
  }
  for (double& w : weight) {
    w /= sum;
  }
  return weight;
}

VoxelBox bounds_of(const LabelImage& image, MaterialId material) {
  VoxelBox box{image.frame.size, {-1, -1, -1}};  // empty
  const Index3& size = image.frame.size;
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel
    {
      VoxelBox mine = box;
#pragma omp for nowait
      for (int k = 0; k < size[2]; ++k) {
        for (int j = 0; j < size[1]; ++j) {
          const auto* row = voxels + image.frame.offset(0, j, k);
          for (int i = 0, end = 0; i < size[0]; i = end) {
            end = end_of_run(row, i, size[0]);
            if (row[i] == material) {
              mine.low = {std::min(mine.low[0], i), std::min(mine.low[1], j), std::min(mine.low[2], k)};
              mine.high = {std::max(mine.high[0], end - 1), std::max(mine.high[1], j),
                           std::max(mine.high[2], k)};
            }
          }
        }
      }
#pragma omp critical(cbc3d_smooth_bounds)
      for (std::size_t a = 0; a < 3; ++a) {
        box.low[a] = std::min(box.low[a], mine.low[a]);
        box.high[a] = std::max(box.high[a], mine.high[a]);
      }
    }
  });
  return box;
}

// Smoothed indicators of the materials within the kernel around a voxel. There are few of them, and never
// more than one per voxel. Materials that collide in the hash table take the next free place.
class MaterialsInReach {
 public:
  void clear() {
    for (std::size_t n = 0; n < count_; ++n) {
      table_[used_[n]].held = false;
    }
    count_ = 0;
    last_ = table_.size() - 1;
  }
  void add(MaterialId material, double weight) {
    if (!table_[last_].held || table_[last_].material != material) {
      find(material);
    }
    table_[last_].sum += weight;
  }
  [[nodiscard]] std::pair<double, double> own_and_largest_other(MaterialId own) const {
    std::pair<double, double> result{0, 0};
    for (std::size_t n = 0; n < count_; ++n) {
      const Entry& entry = table_[used_[n]];
      double& to = entry.material == own ? result.first : result.second;
      to = std::max(to, entry.sum);
    }
    return result;
  }

 private:
  struct Entry {
    double sum = 0;
    MaterialId material = 0;
    bool held = false;
  };

  void find(MaterialId material) {
    last_ = material % table_.size();
    while (table_[last_].held && table_[last_].material != material) {
      last_ = (last_ + 1) % table_.size();
    }
    if (!table_[last_].held) {
      table_[last_] = {0, material, true};
      used_[count_++] = static_cast<std::uint8_t>(last_);
    }
  }

  std::array<Entry, 256> table_;  // over twice what 125 voxels can hold
  std::array<std::uint8_t, 125> used_{};
  std::size_t count_ = 0, last_ = 0;
};

// Evaluates s and marches the cells of one layer at a time.
class Marcher {
 public:
  Marcher(const LabelImage& image, MaterialId material, const VoxelBox& box)
      : image_(image),
        material_(material),
        box_(box),
        width_(static_cast<std::size_t>(box.high[0] - box.low[0] + 3)),
        height_(static_cast<std::size_t>(box.high[1] - box.low[1] + 3)),
        layers_{std::vector<float>(width_ * height_), std::vector<float>(width_ * height_)} {}

  // Cells between the voxel layers k and k + 1. Fields are kept from one layer to the next.
  void march(int k, std::vector<SmoothTriangle>& found) {
    for (const int layer : {k, k + 1}) {
      auto& held = held_[static_cast<std::size_t>(layer & 1)];
      if (held != layer) {
        std::fill(field(layer).begin(), field(layer).end(), 0.0F);  // 0: not yet evaluated
        held = layer;
      }
    }
    for (int j = box_.low[1] - 1; j <= box_.high[1]; ++j) {
      for (int i = box_.low[0] - 1; i <= box_.high[0]; ++i) {
        const unsigned mask = mask_of(i, j, k);
        if (mask != 0 && mask != 255) {
          march_cell({i, j, k}, mask, found);
        }
      }
    }
  }

 private:
  std::vector<float>& field(int layer) { return layers_[static_cast<std::size_t>(layer & 1)]; }

  [[nodiscard]] unsigned mask_of(int i, int j, int k) const {
    unsigned mask = 0;
    for (unsigned c = 0; c < 8; ++c) {
      const bool inside =
          image_.at_or_background(i + kCorners[c][0], j + kCorners[c][1], k + kCorners[c][2]) == material_;
      mask |= inside ? 1U << c : 0U;
    }
    return mask;
  }

  void march_cell(const Index3& at, unsigned mask, std::vector<SmoothTriangle>& found) {
    std::array<double, 8> value;
    for (std::size_t c = 0; c < 8; ++c) {
      value[c] = value_at(at[0] + kCorners[c][0], at[1] + kCorners[c][1], at[2] + kCorners[c][2]);
    }
    const auto* edge = vtkMarchingCubesTriangleCases::GetCases()[mask].edges;
    for (; *edge >= 0; edge += 3) {
      std::array<Vec3, 3> p;
      std::array<MaterialId, 3> other{};
      std::array<std::uint64_t, 3> number{};
      for (std::size_t n = 0; n < 3; ++n) {
        const auto [from, to] = kEdges[static_cast<std::size_t>(edge[n])];
        p[n] = crossing(at, from, to, value);
        number[n] = number_of(at, from, to);
        other[n] = corner_material(at, value[from] > 0 ? to : from);
      }
      const MaterialId most = other[1] == other[2] ? other[1] : other[0];
      found.push_back({{p[0], p[1], p[2]}, most, number});
    }
  }

  // Of the line between two corners: its lower end in the image padded by one voxel, and its axis.
  [[nodiscard]] std::uint64_t number_of(const Index3& at, std::size_t from, std::size_t to) const {
    std::uint64_t voxel = 0;
    for (std::size_t a = 3; a-- > 0;) {
      voxel = voxel * static_cast<std::uint64_t>(image_.frame.size[a] + 2) +
              static_cast<std::uint64_t>(at[a] + kCorners[from][a] + 1);
    }
    const std::uint64_t axis = kCorners[from][0] != kCorners[to][0]   ? 0
                               : kCorners[from][1] != kCorners[to][1] ? 1
                                                                      : 2;
    return 3 * voxel + axis;
  }

  [[nodiscard]] MaterialId corner_material(const Index3& at, std::size_t corner) const {
    const Index3& c = kCorners[corner];
    return image_.at_or_background(at[0] + c[0], at[1] + c[1], at[2] + c[2]);
  }

  [[nodiscard]] Vec3 crossing(const Index3& at, std::size_t from, std::size_t to,
                              const std::array<double, 8>& value) const {
    const auto centre = [&](std::size_t corner) {
      const Index3& c = kCorners[corner];
      return image_.frame.local_centre(at[0] + c[0], at[1] + c[1], at[2] + c[2]);
    };
    const Vec3 a = centre(from), b = centre(to);
    return a + value[from] / (value[from] - value[to]) * (b - a);
  }

  double value_at(int i, int j, int k) {
    const int u = i - box_.low[0] + 1, v = j - box_.low[1] + 1;
    float& held = field(k)[static_cast<std::size_t>(v) * width_ + static_cast<std::size_t>(u)];
    if (held == 0.0F) {
      held = static_cast<float>(evaluate(i, j, k));
    }
    return static_cast<double>(held);
  }

  double evaluate(int i, int j, int k) {
    reach_.clear();
    for (int dk = -kReach; dk <= kReach; ++dk) {
      for (int dj = -kReach; dj <= kReach; ++dj) {
        const double row = weight(dk) * weight(dj);
        for (int di = -kReach; di <= kReach; ++di) {
          reach_.add(image_.at_or_background(i + di, j + dj, k + dk), row * weight(di));
        }
      }
    }
    const auto [own, largest_other] = reach_.own_and_largest_other(material_);
    const bool inside = image_.at_or_background(i, j, k) == material_;
    return inside ? std::max(own - largest_other, kKeptSign) : std::min(own - largest_other, -kKeptSign);
  }

  static double weight(int offset) {
    static const auto weights = gaussian();
    const int n = offset + kReach;
    return weights[static_cast<std::size_t>(n)];
  }

  const LabelImage& image_;
  MaterialId material_;
  VoxelBox box_;
  std::size_t width_, height_;
  std::array<std::vector<float>, 2> layers_;
  std::array<int, 2> held_{-100, -100};
  MaterialsInReach reach_;
};

}  // namespace

std::vector<SmoothTriangle> smooth_surface(const LabelImage& image, MaterialId material) {
  return smooth_surface(image, material, bounds_of(image, material));
}

std::vector<SmoothTriangle> smooth_surface(const LabelImage& image, MaterialId material,
                                           const VoxelBox& box) {
  if (material == kBackground || box.low[0] > box.high[0]) {
    return {};
  }
  const int first = box.low[2] - 1;
  std::vector<std::vector<SmoothTriangle>> layers(static_cast<std::size_t>(box.high[2] - first + 1));
#pragma omp parallel if (layers.size() > 8)
  {
    Marcher marcher(image, material, box);
#pragma omp for schedule(dynamic, 8)
    for (std::size_t n = 0; n < layers.size(); ++n) {
      marcher.march(first + static_cast<int>(n), layers[n]);
    }
  }
  std::vector<SmoothTriangle> triangles;
  triangles.reserve(std::accumulate(layers.begin(), layers.end(), std::size_t{0},
                                    [](std::size_t sum, const auto& layer) { return sum + layer.size(); }));
  for (auto& layer : layers) {
    triangles.insert(triangles.end(), layer.begin(), layer.end());
    layer = {};
  }
  return triangles;
}

}  // namespace cbc3d::metrics
