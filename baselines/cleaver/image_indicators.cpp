#include "baselines/cleaver/image_indicators.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines::cleaver {
namespace {

// The Gaussian's weights of the voxels around a place along one axis, with their indices moved into the
// image: beyond the border the outermost voxels go on, so that the border bends no boundary.
struct AxisWeights {
  static constexpr int kMost = static_cast<int>(2 * ImageIndicators::kReach * ImageIndicators::kMostBlur) + 2;
  std::size_t count = 0;
  std::array<int, kMost> index;
  std::array<double, kMost> weight;

  AxisWeights(double place, double blur, double reach, int size) {
    const int first = static_cast<int>(std::ceil(place - reach));
    const int last = static_cast<int>(std::floor(place + reach));
    // Two exponentials and a recurrence give the Gaussian at steps of one voxel.
    const double inverse = 1 / (blur * blur);
    const double start = first - place;
    double value = std::exp(-0.5 * start * start * inverse);
    double ratio = std::exp(-(start + 0.5) * inverse);
    const double factor = std::exp(-inverse);
    double sum = 0;
    for (int i = first; i <= last; ++i) {
      index[count] = std::clamp(i, 0, size - 1);
      weight[count++] = value;
      sum += value;
      value *= ratio;
      ratio *= factor;
    }
    if (count == 0 || !(sum > 1e-300)) {
      take_nearest(place, size);
      return;
    }
    for (std::size_t i = 0; i < count; ++i) weight[i] /= sum;
  }

  void take_nearest(double place, int size) {
    count = 1;
    index[0] = std::clamp(static_cast<int>(std::floor(place + 0.5)), 0, size - 1);
    weight[0] = 1;
  }
};

// A reach of at least one voxel finds the nearest one however little is blurred.
Vec3 reach_of(const Vec3& blur) {
  constexpr double kReach = ImageIndicators::kReach;
  return {std::max(kReach * blur.x, 1.0), std::max(kReach * blur.y, 1.0), std::max(kReach * blur.z, 1.0)};
}

template <typename Shares>
void add_share(Shares& shares, MaterialId material, double value) {
  for (auto& share : shares) {
    if (share.material == material) {
      share.value += value;
      return;
    }
  }
  shares.push_back({material, value});
}

// Adds the weights of a row of voxels to the shares of their materials, one run of a material at a time.
template <typename Shares, typename Voxel>
void add_row(Shares& shares, const Voxel* row, const AxisWeights& x, double weight) {
  MaterialId run = row[x.index[0]];
  double sum = 0;
  for (std::size_t i = 0; i < x.count; ++i) {
    const MaterialId material = row[x.index[i]];
    if (material != run) {
      add_share(shares, run, weight * sum);
      run = material;
      sum = 0;
    }
    sum += x.weight[i];
  }
  add_share(shares, run, weight * sum);
}

}  // namespace

ImageIndicators::ImageIndicators(const LabelImage& image, const Vec3& blur_voxels)
    : image_(image), blur_(blur_voxels), reach_(reach_of(blur_voxels)), bricks_(image, reach_) {
  const Vec3& spacing = image.frame.spacing_mm;
  for (int axis = 0; axis < 3; ++axis) {
    low_[axis] = -0.5 * spacing[axis];
    high_[axis] = (image.frame.size[static_cast<std::size_t>(axis)] - 0.5) * spacing[axis];
  }
  tolerance_ = 1e-9 * (high_ - low_).norm();
  is_sharp_.assign(image.material_count(), 0);
  find_sharp_materials();
}

const ImageIndicators::Shares& ImageIndicators::shares_at(const Vec3& place) const {
  thread_local Shares shares;
  shares.clear();
  const Index3& size = image_.frame.size;
  const Vec3 voxel = {place.x / image_.frame.spacing_mm.x, place.y / image_.frame.spacing_mm.y,
                      place.z / image_.frame.spacing_mm.z};
  const AxisWeights x(voxel.x, blur_.x, reach_.x, size[0]);
  const AxisWeights y(voxel.y, blur_.y, reach_.y, size[1]);
  const AxisWeights z(voxel.z, blur_.z, reach_.z, size[2]);
  image_.voxels.visit([&](const auto* voxels) {
    for (std::size_t k = 0; k < z.count; ++k) {
      for (std::size_t j = 0; j < y.count; ++j) {
        const auto* row = voxels + image_.frame.offset(0, y.index[j], z.index[k]);
        add_row(shares, row, x, z.weight[k] * y.weight[j]);
      }
    }
  });
  if (!sharp_.empty()) sharpen(voxel, shares);
  return shares;
}

// The trilinear interpolation of a label's mask.
double ImageIndicators::mask_at(const Vec3& voxel, MaterialId material) const {
  double mask = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    Index3 at{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double below = std::floor(voxel[axis]);
      const bool upper = ((corner >> axis) & 1) != 0;
      weight *= upper ? voxel[axis] - below : 1 - (voxel[axis] - below);
      at[a] = std::clamp(static_cast<int>(below) + (upper ? 1 : 0), 0, image_.frame.size[a] - 1);
    }
    if (image_.at(at[0], at[1], at[2]) == material) mask += weight;
  }
  return mask;
}

// A sharp label's indicator equals the largest of the others where its mask is one half.
void ImageIndicators::sharpen(const Vec3& voxel, Shares& shares) const {
  const auto is_sharp = [&](const Share& share) { return is_sharp_[share.material] != 0; };
  if (std::none_of(shares.begin(), shares.end(), is_sharp)) return;
  double most = 0;
  for (const Share& share : shares)
    if (!is_sharp(share)) most = std::max(most, share.value);
  if (most == 0) most = 1;
  for (Share& share : shares)
    if (is_sharp(share)) share.value = 2 * mask_at(voxel, share.material) * most;
}

MaterialId ImageIndicators::material_at(const Vec3& place) const {
  if (is_outside(place)) return kBackground;
  const std::uint32_t uniform = bricks_.at(place);
  if (uniform != UniformBricks::kMixed) return static_cast<MaterialId>(uniform);
  const Shares& shares = shares_at(place);
  Share best = shares.front();
  for (const Share& share : shares) {
    const bool better =
        share.value > best.value || (share.value == best.value && share.material < best.material);
    if (better) best = share;
  }
  return best.material;
}

bool ImageIndicators::is_outside(const Vec3& place) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (place[axis] < low_[axis] - tolerance_ || place[axis] > high_[axis] + tolerance_) return true;
  }
  return false;
}

double ImageIndicators::lead(const Vec3& place, MaterialId a, MaterialId b) const {
  double difference = 0;
  for (const Share& share : shares_at(place)) {
    if (share.material == a) difference += share.value;
    if (share.material == b) difference -= share.value;
  }
  return difference;
}

// The Illinois variant of the false position: it keeps its bracket, and its values alone decide.
double ImageIndicators::crossing_inside(const Vec3& from, const Vec3& to, MaterialId a, MaterialId b) const {
  constexpr int kMostSteps = 8;
  constexpr double kSmallLead = 1e-3;
  double t0 = 0, t1 = 1;
  double f0 = lead(from, a, b);
  if (f0 <= 0) return 0;
  double f1 = lead(to, a, b);
  if (f1 >= 0) return 1;
  double t = 0.5;
  int side = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    t = (f0 * t1 - f1 * t0) / (f0 - f1);
    const double f = lead(from + (to - from) * t, a, b);
    if (std::abs(f) < kSmallLead) return t;
    if (f > 0) {
      t0 = t, f0 = f;
      if (side == 1) f1 /= 2;
      side = 1;
    } else {
      t1 = t, f1 = f;
      if (side == -1) f0 /= 2;
      side = -1;
    }
  }
  return t;
}

double ImageIndicators::leaving_box(const Vec3& from, const Vec3& to) const {
  double t = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double step = to[axis] - from[axis];
    if (step < 0 && to[axis] < low_[axis]) t = std::min(t, (low_[axis] - from[axis]) / step);
    if (step > 0 && to[axis] > high_[axis]) t = std::min(t, (high_[axis] - from[axis]) / step);
  }
  return std::max(t, 0.0);
}

double ImageIndicators::crossing(const Vec3& from, const Vec3& to, MaterialId a, MaterialId b) const {
  const bool starts_outside = is_outside(from);
  const bool ends_outside = is_outside(to);
  if (starts_outside && ends_outside) return a == kBackground ? 1 : 0;
  if (starts_outside) return 1 - crossing(to, from, b, a);
  if (!ends_outside) return crossing_inside(from, to, a, b);
  // The exterior begins on the box, unless the label ends before it.
  const double t = leaving_box(from, to);
  const double inside = crossing_inside(from, from + (to - from) * t, a, b);
  return inside < 1 ? inside * t : t;
}

bool ImageIndicators::is_surely_background(const Vec3& low, const Vec3& high) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (high[axis] < low_[axis] || low[axis] > high_[axis]) return true;
  }
  return bricks_.are_background(low, high);
}

// A label is sharp when it prevails at fewer than a quarter of those of its voxels that are looked at: all of
// them, or kMostLooks at equal steps.
void ImageIndicators::find_sharp_materials() {
  constexpr double kLeastShare = 0.25;
  constexpr std::size_t kMostLooks = 2048;
  const std::vector<std::size_t> counts = image_.voxels_per_material();
  std::vector<std::size_t> seen(counts.size(), 0);
  std::vector<std::size_t> places;
  std::vector<MaterialId> materials;
  for (std::size_t v = 0; v < image_.voxels.size(); ++v) {
    const MaterialId material = image_.voxels[v];
    if (material == kBackground) continue;
    const std::size_t step = (counts[material] + kMostLooks - 1) / kMostLooks;
    if (seen[material]++ % step != 0) continue;
    places.push_back(v);
    materials.push_back(material);
  }
  std::vector<char> prevails(places.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Index3 at = image_.frame.index_of(places[n]);
    prevails[n] = material_at(image_.frame.local_centre(at[0], at[1], at[2])) == materials[n] ? 1 : 0;
  }
  std::vector<std::size_t> looked(counts.size(), 0), kept(counts.size(), 0);
  for (std::size_t n = 0; n < places.size(); ++n) {
    ++looked[materials[n]];
    kept[materials[n]] += prevails[n] != 0 ? 1 : 0;
  }
  for (std::size_t m = 1; m < counts.size(); ++m) {
    if (looked[m] == 0 || static_cast<double>(kept[m]) >= kLeastShare * static_cast<double>(looked[m]))
      continue;
    sharp_.push_back(static_cast<MaterialId>(m));
  }
  for (const MaterialId material : sharp_) is_sharp_[material] = 1;
}

}  // namespace cbc3d::baselines::cleaver
