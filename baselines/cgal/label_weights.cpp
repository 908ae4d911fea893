#include "baselines/cgal/label_weights.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines {
namespace {

// A box of voxels: first and past-the-end index along each axis, in the padded grid.
struct Box {
  Index3 first{0, 0, 0}, end{0, 0, 0};
  [[nodiscard]] int length(int axis) const {
    return end[static_cast<std::size_t>(axis)] - first[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(length(0)) * static_cast<std::size_t>(length(1)) *
           static_cast<std::size_t>(length(2));
  }
};

// The Gaussian at the whole numbers of voxels up to four standard deviations, with the sum 1.
std::vector<float> kernel_of(double sigma_voxels) {
  const int radius = static_cast<int>(std::ceil(4 * sigma_voxels));
  std::vector<double> values;
  double sum = 0;
  for (int n = -radius; n <= radius; ++n) {
    values.push_back(std::exp(-0.5 * n * n / (sigma_voxels * sigma_voxels)));
    sum += values.back();
  }
  std::vector<float> kernel;
  kernel.reserve(values.size());
  for (const double value : values) kernel.push_back(static_cast<float>(value / sum));
  return kernel;
}

// Convolves along one axis; outside its box the field is 0.
std::vector<float> blurred(const std::vector<float>& field, const Box& box, int axis,
                           const std::vector<float>& kernel) {
  const int radius = static_cast<int>(kernel.size() / 2);
  const int length = box.length(axis);
  std::size_t stride = 1;
  for (int a = 0; a < axis; ++a) stride *= static_cast<std::size_t>(box.length(a));
  std::vector<float> result(field.size(), 0.0F);
#pragma omp parallel for schedule(static)
  for (std::int64_t signed_v = 0; signed_v < static_cast<std::int64_t>(field.size()); ++signed_v) {
    const auto v = static_cast<std::size_t>(signed_v);
    const int at = static_cast<int>(v / stride % static_cast<std::size_t>(length));
    const int from = std::max(-radius, -at), to = std::min(radius, length - 1 - at);
    float sum = 0;
    for (int n = from; n <= to; ++n) {
      const int of_kernel = n + radius;
      sum += kernel[static_cast<std::size_t>(of_kernel)] * field[v + static_cast<std::size_t>(n) * stride];
    }
    result[v] = sum;
  }
  return result;
}

// The blurred indicators of all labels but the background's, summed and at their largest.
class Weights {
 public:
  Weights(const LabelImage& image, int padding, double sigma_mm) : image_(image), padding_(padding) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      size_[a] = image.frame.size[a] + 2 * padding;
      kernels_[a] = kernel_of(sigma_mm / image.frame.spacing_mm[axis]);
    }
    const std::size_t count = offset(size_[0] - 1, size_[1] - 1, size_[2] - 1) + 1;
    sums_.assign(count, 0.0F);
    largest_.assign(count, 0.0F);
  }

  void add(MaterialId material, const Box& box) {
    std::vector<float> field(box.count(), 0.0F);
    visit(box, [&](std::size_t in_box, int i, int j, int k) {
      field[in_box] =
          image_.at_or_background(i - padding_, j - padding_, k - padding_) == material ? 1.0F : 0.0F;
    });
    for (int axis = 0; axis < 3; ++axis)
      field = blurred(field, box, axis, kernels_[static_cast<std::size_t>(axis)]);
    visit(box, [&](std::size_t in_box, int i, int j, int k) {
      const std::size_t v = offset(i, j, k);
      sums_[v] += field[in_box];
      largest_[v] = std::max(largest_[v], field[in_box]);
    });
  }

  // The background's blurred indicator is what the others leave of 1.
  [[nodiscard]] std::vector<std::uint8_t> rounded() const {
    std::vector<std::uint8_t> weights(sums_.size());
    for (std::size_t v = 0; v < sums_.size(); ++v) {
      const float largest = std::max(largest_[v], 1.0F - sums_[v]);
      weights[v] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(largest, 0.0F, 1.0F)));
    }
    return weights;
  }

  // For every material the box of its voxels with the reach of the kernels, within the grid.
  [[nodiscard]] std::vector<Box> boxes() const {
    std::vector<Box> boxes(image_.material_count(), Box{size_, {0, 0, 0}});
    const Index3& n = image_.frame.size;
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j)
        for (int i = 0; i < n[0]; ++i) extend(boxes[image_.at_or_background(i, j, k)], {i, j, k});
    }
    return boxes;
  }

 private:
  [[nodiscard]] std::size_t offset(int i, int j, int k) const {
    return ImageFrame{.size = size_}.offset(i, j, k);
  }

  void extend(Box& box, const Index3& voxel) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const int reach = static_cast<int>(kernels_[a].size() / 2);
      box.first[a] = std::clamp(voxel[a] + padding_ - reach, 0, box.first[a]);
      box.end[a] = std::clamp(voxel[a] + padding_ + reach + 1, box.end[a], size_[a]);
    }
  }

  template <typename Visit>
  static void visit(const Box& box, Visit visit) {
    std::size_t in_box = 0;
    for (int k = box.first[2]; k < box.end[2]; ++k) {
      for (int j = box.first[1]; j < box.end[1]; ++j)
        for (int i = box.first[0]; i < box.end[0]; ++i) visit(in_box++, i, j, k);
    }
  }

  const LabelImage& image_;
  int padding_;
  Index3 size_{0, 0, 0};
  std::array<std::vector<float>, 3> kernels_;
  std::vector<float> sums_, largest_;
};

}  // namespace

std::vector<std::uint8_t> label_weights(const LabelImage& image, int padding, double sigma_mm) {
  Weights weights(image, padding, sigma_mm);
  const std::vector<Box> boxes = weights.boxes();
  for (std::size_t material = 1; material < boxes.size(); ++material) {
    const Box& box = boxes[material];
    if (box.end[0] > box.first[0]) weights.add(static_cast<MaterialId>(material), box);
  }
  return weights.rounded();
}

}  // namespace cbc3d::baselines
