#include "baselines/cleaver/image_indicators.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines::cleaver {
namespace {

// The Gaussian's weights of the voxels around a place along one axis, with their indices moved into the
// image: beyond the border the outermost voxels go on, so that the border bends no boundary.
struct AxisWeights {
  static constexpr int kMost = static_cast<int>(2 * ImageIndicators::kReach * ImageIndicators::kMostBlur) + 2;
  int count = 0;
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
      index[static_cast<std::size_t>(count)] = std::clamp(i, 0, size - 1);
      weight[static_cast<std::size_t>(count++)] = value;
      sum += value;
      value *= ratio;
      ratio *= factor;
    }
    if (count == 0 || !(sum > 1e-300))
      take_nearest(place, size);
    else
      for (int i = 0; i < count; ++i) weight[static_cast<std::size_t>(i)] /= sum;
  }

  void take_nearest(double place, int size) {
    count = 1;
    index[0] = std::clamp(static_cast<int>(std::floor(place + 0.5)), 0, size - 1);
    weight[0] = 1;
  }
};

void add_share(std::vector<std::pair<MaterialId, double>>& shares, MaterialId material, double value) {
  for (auto& [known, sum] : shares) {
    if (known == material) {
      sum += value;
      return;
    }
  }
  shares.emplace_back(material, value);
}

int brick_count(int voxels, int brick) {
  return (voxels + brick - 1) / brick;
}

}  // namespace

ImageIndicators::ImageIndicators(const LabelImage& image, const Vec3& blur_voxels)
    : image_(image), blur_(blur_voxels) {
  const Vec3& spacing = image.frame.spacing_mm;
  for (int axis = 0; axis < 3; ++axis) {
    // A reach of at least one voxel finds the nearest one however little is blurred.
    reach_[axis] = std::max(kReach * blur_[axis], 1.0);
    low_[axis] = -0.5 * spacing[axis];
    high_[axis] = (image.frame.size[static_cast<std::size_t>(axis)] - 0.5) * spacing[axis];
  }
  tolerance_ = 1e-9 * (high_ - low_).norm();
  is_sharp_.assign(image.material_count(), 0);
  find_uniform_bricks();
  find_sharp_materials();
}

void ImageIndicators::find_uniform_bricks() {
  const Index3& size = image_.frame.size;
  for (std::size_t a = 0; a < 3; ++a) bricks_[a] = brick_count(size[a], kBrick);
  const auto offset = [&](int i, int j, int k) {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(bricks_[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(bricks_[0]) +
           static_cast<std::size_t>(i);
  };
  std::vector<std::uint32_t> own(offset(0, 0, bricks_[2]));
  image_.voxels.visit([&](const auto* voxels) {
#pragma omp parallel for schedule(static)
    for (int k = 0; k < bricks_[2]; ++k) {
      for (int j = 0; j < bricks_[1]; ++j) {
        for (int i = 0; i < bricks_[0]; ++i) {
          const std::uint32_t first = voxels[image_.frame.offset(i * kBrick, j * kBrick, k * kBrick)];
          std::uint32_t found = first;
          for (int z = k * kBrick; z < std::min((k + 1) * kBrick, size[2]); ++z) {
            for (int y = j * kBrick; y < std::min((j + 1) * kBrick, size[1]); ++y) {
              const auto* row = voxels + image_.frame.offset(0, y, z);
              for (int x = i * kBrick; x < std::min((i + 1) * kBrick, size[0]); ++x) {
                if (row[x] != first) found = kMixed;
              }
            }
          }
          own[offset(i, j, k)] = found;
        }
      }
    }
  });
  // A place belongs to a brick's voxels by half a voxel more than their centres.
  std::array<int, 3> around{};
  for (int axis = 0; axis < 3; ++axis) {
    around[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil((reach_[axis] + 0.5) / kBrick));
  }
  uniform_ = own;
  // Axis by axis: a brick whose neighbours along an axis differ from it is mixed.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<std::uint32_t> before = uniform_;
#pragma omp parallel for schedule(static)
    for (int k = 0; k < bricks_[2]; ++k) {
      for (int j = 0; j < bricks_[1]; ++j) {
        for (int i = 0; i < bricks_[0]; ++i) {
          std::uint32_t& found = uniform_[offset(i, j, k)];
          Index3 at{i, j, k};
          const int here = at[axis];
          const int last = std::min(bricks_[axis] - 1, here + around[axis]);
          for (int n = std::max(0, here - around[axis]); n <= last && found != kMixed; ++n) {
            at[axis] = n;
            if (before[offset(at[0], at[1], at[2])] != found) found = kMixed;
          }
        }
      }
    }
  }
}

std::uint32_t ImageIndicators::brick_at(const Vec3& place) const {
  std::size_t offset = 0;
  for (int axis = 2; axis >= 0; --axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double voxel = place[axis] / image_.frame.spacing_mm[axis] + 0.5;
    const int at =
        std::clamp(static_cast<int>(std::floor(std::clamp(voxel, 0.0, 1e9))), 0, image_.frame.size[a] - 1);
    offset = offset * static_cast<std::size_t>(bricks_[a]) + static_cast<std::size_t>(at / kBrick);
  }
  return uniform_[offset];
}

const ImageIndicators::Shares& ImageIndicators::shares_at(const Vec3& place) const {
  thread_local Shares shares;
  thread_local std::vector<std::pair<MaterialId, double>> sums;
  sums.clear();
  const Index3& size = image_.frame.size;
  const Vec3 voxel = {place.x / image_.frame.spacing_mm.x, place.y / image_.frame.spacing_mm.y,
                      place.z / image_.frame.spacing_mm.z};
  const AxisWeights x(voxel.x, blur_.x, reach_.x, size[0]);
  const AxisWeights y(voxel.y, blur_.y, reach_.y, size[1]);
  const AxisWeights z(voxel.z, blur_.z, reach_.z, size[2]);
  image_.voxels.visit([&](const auto* voxels) {
    for (int k = 0; k < z.count; ++k) {
      for (int j = 0; j < y.count; ++j) {
        const auto* row = voxels + image_.frame.offset(0, y.index[static_cast<std::size_t>(j)],
                                                       z.index[static_cast<std::size_t>(k)]);
        const double weight = z.weight[static_cast<std::size_t>(k)] * y.weight[static_cast<std::size_t>(j)];
        MaterialId run = row[x.index[0]];
        double sum = 0;
        for (int i = 0; i < x.count; ++i) {
          const MaterialId material = row[x.index[static_cast<std::size_t>(i)]];
          if (material != run) {
            add_share(sums, run, weight * sum);
            run = material;
            sum = 0;
          }
          sum += x.weight[static_cast<std::size_t>(i)];
        }
        add_share(sums, run, weight * sum);
      }
    }
  });
  shares.clear();
  for (const auto& [material, value] : sums) shares.push_back({material, value});
  if (!sharp_.empty()) sharpen(voxel, shares);
  return shares;
}

// A sharp label's indicator equals the largest of the others where the trilinear interpolation of its mask is
// one half.
void ImageIndicators::sharpen(const Vec3& voxel, Shares& shares) const {
  double most = 0;
  bool any = false;
  for (const Share& share : shares) {
    if (is_sharp_[share.material] != 0)
      any = true;
    else
      most = std::max(most, share.value);
  }
  if (!any) return;
  if (most == 0) most = 1;
  for (Share& share : shares) {
    if (is_sharp_[share.material] == 0) continue;
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
      if (image_.at(at[0], at[1], at[2]) == share.material) mask += weight;
    }
    share.value = 2 * mask * most;
  }
}

MaterialId ImageIndicators::material_at(const Vec3& place) const {
  if (is_outside(place)) return kBackground;
  const std::uint32_t uniform = brick_at(place);
  if (uniform != kMixed) return static_cast<MaterialId>(uniform);
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
  Index3 first{}, last{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (high[axis] < low_[axis] || low[axis] > high_[axis]) return true;
    const auto brick = [&](double place) {
      const double voxel = std::clamp(std::floor(place / image_.frame.spacing_mm[axis] + 0.5), 0.0,
                                      image_.frame.size[a] - 1.0);
      return static_cast<int>(voxel) / kBrick;
    };
    first[a] = brick(low[axis]);
    last[a] = brick(high[axis]);
  }
  for (int k = first[2]; k <= last[2]; ++k) {
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int i = first[0]; i <= last[0]; ++i) {
        const std::size_t at = (static_cast<std::size_t>(k) * static_cast<std::size_t>(bricks_[1]) +
                                static_cast<std::size_t>(j)) *
                                   static_cast<std::size_t>(bricks_[0]) +
                               static_cast<std::size_t>(i);
        if (uniform_[at] != kBackground) return false;
      }
    }
  }
  return true;
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
