#include "mesher/domain/image_domain.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "mesher/domain/simple_point.hpp"
#include "mesher/domain/tolerances.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// True when voxel `at` (1 or 2 along each axis of the 4x4x4 block) is in no 2x2x2 block of its own side.
bool is_thin_on(const std::array<signed char, 64>& side, int at) {
  const signed char own = side[static_cast<std::size_t>(at)];
  for (int block = 0; block < 8; ++block) {
    const int base = at - (block & 1) - 4 * ((block >> 1) & 1) - 16 * (block >> 2);
    bool whole = true;
    for (const int step : {0, 1, 4, 5, 16, 17, 20, 21}) {
      const int voxel = base + step;
      whole = whole && side[static_cast<std::size_t>(voxel)] == own;
    }
    if (whole) {
      return false;
    }
  }
  return true;
}

/// Value and gradient (per voxel along each axis) of the trilinear function of eight corner values.
double trilinear(const std::array<double, 8>& c, const Vec3& f, Vec3& gradient) {
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  const double x00 = mix(c[0], c[1], f.x);
  const double x10 = mix(c[2], c[3], f.x);
  const double x01 = mix(c[4], c[5], f.x);
  const double x11 = mix(c[6], c[7], f.x);
  const double y0 = mix(x00, x10, f.y);
  const double y1 = mix(x01, x11, f.y);
  gradient.x = mix(mix(c[1] - c[0], c[3] - c[2], f.y), mix(c[5] - c[4], c[7] - c[6], f.y), f.z);
  gradient.y = mix(x10 - x00, x11 - x01, f.z);
  gradient.z = y1 - y0;
  return mix(y0, y1, f.z);
}

/// True when a voxel is in no 2x2x2 block of its own material.
bool is_thin_at(const LabelImage& image, const Index3& at) {
  const MaterialId own = image.at_or_background(at[0], at[1], at[2]);
  for (int block = 0; block < 8; ++block) {
    bool whole = true;
    for (int corner = 0; corner < 8 && whole; ++corner) {
      whole = image.at_or_background(at[0] - (block & 1) + (corner & 1),
                                     at[1] - (block >> 1 & 1) + (corner >> 1 & 1),
                                     at[2] - (block >> 2) + (corner >> 2)) == own;
    }
    if (whole) {
      return false;
    }
  }
  return true;
}

Index3 neighbour_across(Index3 at, std::size_t side) {
  at[side / 2] += side % 2 == 0 ? 1 : -1;
  return at;
}

/// The thin voxels of a slice, background's beside labels too, whose like neighbours across faces are thick.
void add_candidates(const LabelImage& image, int k, std::vector<std::size_t>& candidates) {
  const auto is_candidate = [&](const Index3& at) {
    const MaterialId own = image.at(at[0], at[1], at[2]);
    bool all_thick = is_thin_at(image, at);
    for (std::size_t side = 0; side < 6 && all_thick; ++side) {
      const Index3 next = neighbour_across(at, side);
      all_thick = image.at_or_background(next[0], next[1], next[2]) != own || !is_thin_at(image, next);
    }
    return all_thick;
  };
  for (int j = 0; j < image.frame.size[1]; ++j) {
    for (int i = 0; i < image.frame.size[0]; ++i) {
      if (is_boundary_voxel(image, i, j, k) && is_candidate({i, j, k})) {
        candidates.push_back(image.frame.offset(i, j, k));
      }
    }
  }
}

/// True when a voxel is simple with the bumps before it gone. Beside another material's bump it is not known
/// what is to be there.
bool is_simple_bump(const LabelImage& image, const std::vector<std::size_t>& bumps, const Index3& at) {
  const MaterialId own = image.at(at[0], at[1], at[2]);
  VoxelNeighbourhood around{};
  for (std::size_t n = 0; n < around.size(); ++n) {
    const Index3 next = voxel_neighbour(at, n);
    const bool is_own = image.at_or_background(next[0], next[1], next[2]) == own;
    const bool was_bump =
        image.frame.contains(next[0], next[1], next[2]) &&
        std::binary_search(bumps.begin(), bumps.end(), image.frame.offset(next[0], next[1], next[2]));
    if (was_bump && !is_own) {
      return false;
    }
    around[n] = is_own && !was_bump;
  }
  return is_simple(around);
}

/// The field of two materials in a cell between eight voxel centres, as a thread last found it. The steps of
/// a vertex and the facets at it stay in a few cells, so that most fields are asked for again at once.
struct KnownField {
  std::uint64_t domain = 0;  // its number; 0: nothing is known
  Index3 low{};
  std::array<MaterialId, 2> materials{};
  bool is_near = false;
  std::array<double, 8> corner{};

  [[nodiscard]] bool is_of(std::uint64_t number, const Index3& at, MaterialId a, MaterialId b) const {
    return domain == number && low == at && materials[0] == a && materials[1] == b;
  }
};

/// Where the field is kept, one place for many cells.
KnownField& known_field(const Index3& low, MaterialId a, MaterialId b) {
  constexpr std::size_t kPlaces = 256;
  static thread_local std::array<KnownField, kPlaces> known;
  const auto part = [](int value, std::uint32_t factor) {
    return static_cast<std::uint32_t>(value) * factor;
  };
  const std::uint32_t mixed =
      part(low[0], 1) + part(low[1], 7) + part(low[2], 49) + part(a, 101) + part(b, 37);
  return known[mixed % kPlaces];
}

/// Numbers domains from 1 on, so that a new one in an old one's memory is not taken for it.
std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::vector<std::size_t> find_bumps(const LabelImage& image) {
  std::vector<std::vector<std::size_t>> of_slice(static_cast<std::size_t>(image.frame.size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < image.frame.size[2]; ++k) {
    add_candidates(image, k, of_slice[static_cast<std::size_t>(k)]);
  }
  std::vector<std::size_t> bumps;
  for (const auto& slice : of_slice) {
    for (const std::size_t offset : slice) {
      if (is_simple_bump(image, bumps, image.frame.index_of(offset))) {
        bumps.push_back(offset);
      }
    }
  }
  return bumps;
}

}  // namespace

ImageDomain::ImageDomain(const LabelImage& image, const ImageDomainOptions& options)
    : image_(image),
      options_(options),
      number_(next_number()),
      label_of_(first_of_label(image)),
      voxel_mm_(std::cbrt(image.frame.spacing_mm.x * image.frame.spacing_mm.y * image.frame.spacing_mm.z)) {}

const MaterialVoxels& ImageDomain::voxels() const {
  std::call_once(voxels_once_, [this] {
    voxels_ = count_materials(image_);
    volumes_mm3_.assign(voxels_.count.size(), 0.0);
    for (std::size_t m = 1; m < volumes_mm3_.size(); ++m) {
      volumes_mm3_[m] = static_cast<double>(voxels_.count[m]) * cell_mm3();
    }
  });
  return voxels_;
}

const std::vector<double>& ImageDomain::volumes_mm3() const {
  static_cast<void>(voxels());
  return volumes_mm3_;
}

double ImageDomain::cell_mm3() const {
  const Vec3& spacing = image_.frame.spacing_mm;
  return spacing.x * spacing.y * spacing.z;
}

double ImageDomain::thin_reach_mm() const {
  const Vec3& spacing = image_.frame.spacing_mm;
  return tolerances::kThinReachSpacings * std::max({spacing.x, spacing.y, spacing.z});
}

std::vector<BoundarySample> ImageDomain::find_samples() const {
  return boundary_samples(image_);
}

bool ImageDomain::is_thin(const BoundarySample& sample) const {
  Index3 at{};
  for (int axis = 0; axis < 3; ++axis) {
    at[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::lround(sample.centre()[axis] / image_.frame.spacing_mm[axis]));
  }
  if (is_thin_voxel(at)) {
    return true;
  }
  for (std::size_t side = 0; side < 6 && sample.other == kBackground; ++side) {
    Index3 next = at;
    next[side / 2] += side % 2 == 0 ? 1 : -1;
    if (image_.at_or_background(next[0], next[1], next[2]) == sample.other && is_thin_voxel(next)) {
      return true;
    }
  }
  return false;
}

bool ImageDomain::is_thin_voxel(const Index3& at) const {
  return is_thin_at(image_, at) && !is_bump(at);
}

bool ImageDomain::is_bump(const Index3& at) const {
  std::call_once(bumps_once_, [this] { bumps_ = find_bumps(image_); });
  return image_.frame.contains(at[0], at[1], at[2]) &&
         std::binary_search(bumps_.begin(), bumps_.end(), image_.frame.offset(at[0], at[1], at[2]));
}

std::optional<Vec3> ImageDomain::nearest_boundary(const Vec3& x, MaterialId material) const {
  return nearest_boundary_voxel(image_, x, material, tolerances::kNearestSearch * scale_mm());
}

bool ImageDomain::is_near_boundary(const Vec3& x, MaterialId material) const {
  return has_boundary_voxel_near(image_, x, material, tolerances::kFarLimit * scale_mm());
}

double ImageDomain::clamped(double value, const std::array<signed char, 64>& side, int at,
                            const Index3& voxel) const {
  const double own = side[static_cast<std::size_t>(at)];
  if (own == 0 || own * value >= options_.hold_thin) {
    return value;
  }
  if (!is_thin_on(side, at)) {
    return own * std::max(own * value, options_.hold);
  }
  return is_bump(voxel) ? value : own * std::max(own * value, options_.hold_thin);
}

bool ImageDomain::corners(const Index3& low, MaterialId a, MaterialId b,
                          std::array<double, 8>& corner) const {
  KnownField& known = known_field(low, a, b);
  if (!known.is_of(number_, low, a, b)) {
    known.domain = number_;
    known.low = low;
    known.materials = {a, b};
    known.is_near = find_corners(low, a, b, known.corner);
  }
  corner = known.corner;
  return known.is_near;
}

bool ImageDomain::find_corners(const Index3& low, MaterialId a, MaterialId b,
                               std::array<double, 8>& corner) const {
  std::array<signed char, 64> side{};
  const Index3& size = image_.frame.size;
  const bool inside = low[0] >= 1 && low[1] >= 1 && low[2] >= 1 && low[0] + 2 < size[0] &&
                      low[1] + 2 < size[1] && low[2] + 2 < size[2];
  std::size_t n = 0;
  int of_a = 0;
  int of_b = 0;
  for (int k = low[2] - 1; k < low[2] + 3; ++k) {
    for (int j = low[1] - 1; j < low[1] + 3; ++j) {
      for (int i = low[0] - 1; i < low[0] + 3; ++i, ++n) {
        const MaterialId m = inside ? image_.at(i, j, k) : image_.at_or_background(i, j, k);
        side[n] = static_cast<signed char>((m == a ? 1 : 0) - (m == b ? 1 : 0));
        of_a += m == a ? 1 : 0;
        of_b += m == b ? 1 : 0;
      }
    }
  }
  if (of_a == 0 || of_b == 0) {
    return false;
  }
  // Twice 1 2 1 along each axis, in whole numbers: 64ths at the end.
  std::array<int, 32> along_x{};
  for (std::size_t row = 0; row < 16; ++row) {
    const signed char* s = &side[4 * row];
    along_x[2 * row] = s[0] + 2 * s[1] + s[2];
    along_x[2 * row + 1] = s[1] + 2 * s[2] + s[3];
  }
  std::array<int, 16> along_y{};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t e = 0; e < 4; ++e) {
      const int* s = &along_x[8 * k + e];
      along_y[4 * k + e] = s[0] + 2 * s[2] + s[4];
    }
  }
  for (std::size_t c = 0; c < 8; ++c) {
    const std::size_t from = 4 * (c >> 2) + (c & 3);
    const double value = (along_y[from] + 2 * along_y[from + 4] + along_y[from + 8]) / 64.0;
    const int at = 21 + static_cast<int>((c & 1) + 4 * ((c >> 1) & 1) + 16 * (c >> 2));
    corner[c] = clamped(value, side, at,
                        {low[0] + static_cast<int>(c & 1), low[1] + static_cast<int>(c >> 1 & 1),
                         low[2] + static_cast<int>(c >> 2)});
  }
  return true;
}

MaterialId ImageDomain::material_at(const Vec3& x) const {
  const Vec3& spacing = image_.frame.spacing_mm;
  const Vec3 at = {x.x / spacing.x, x.y / spacing.y, x.z / spacing.z};
  const Index3 low = {static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                      static_cast<int>(std::floor(at.z))};
  std::array<MaterialId, 8> corner{};
  std::array<MaterialId, 8> candidates{};
  std::size_t count = 0;
  for (std::size_t c = 0; c < 8; ++c) {
    corner[c] =
        image_.at_or_background(low[0] + static_cast<int>(c & 1), low[1] + static_cast<int>(c >> 1 & 1),
                                low[2] + static_cast<int>(c >> 2));
    if (std::find(candidates.begin(), candidates.begin() + count, corner[c]) == candidates.begin() + count) {
      candidates[count++] = corner[c];
    }
  }
  MaterialId best = candidates[0];
  for (std::size_t i = 1; i < count; ++i) {  // pairwise, the winner stays
    std::array<double, 8> field{};
    Vec3 slope;
    if (corners(low, best, candidates[i], field) &&
        trilinear(field, {at.x - low[0], at.y - low[1], at.z - low[2]}, slope) < 0) {
      best = candidates[i];
    }
  }
  return best;
}

BoundaryDistance ImageDomain::boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const {
  const Vec3& spacing = image_.frame.spacing_mm;
  const Vec3 at = {x.x / spacing.x, x.y / spacing.y, x.z / spacing.z};
  const Index3 low = {static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)),
                      static_cast<int>(std::floor(at.z))};
  std::array<double, 8> corner{};
  if (!corners(low, a, b, corner)) {
    return far_boundary_distance(x, a, b);
  }
  Vec3 slope;
  const double value = trilinear(corner, {at.x - low[0], at.y - low[1], at.z - low[2]}, slope);
  slope = {slope.x / spacing.x, slope.y / spacing.y, slope.z / spacing.z};
  const double steepness = slope.norm();
  if (steepness * voxel_mm_ < 0.1) {
    return far_boundary_distance(x, a, b);
  }
  // Where the field is flat the estimate would overshoot; a floor under the slope damps it.
  const double distance = value / std::max(steepness, 0.5 / voxel_mm_);
  return {distance, slope / steepness, std::fabs(distance), true};
}

BoundaryDistance ImageDomain::far_boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const {
  const ImageFrame& frame = image_.frame;
  const auto voxel = [&](int axis) {
    return static_cast<int>(std::floor(x[axis] / frame.spacing_mm[axis] + 0.5));
  };
  const Index3 at = {voxel(0), voxel(1), voxel(2)};
  double nearest_a = kInfinity;
  double nearest_b = nearest_a;
  Vec3 to_a;
  Vec3 to_b;
  Index3 search;
  for (int axis = 0; axis < 3; ++axis) {
    search[static_cast<std::size_t>(axis)] =
        std::min(12, static_cast<int>(2.5 * frame.voxel_diagonal_mm() / frame.spacing_mm[axis]) + 1);
  }
  for (int k = at[2] - search[2]; k <= at[2] + search[2]; ++k) {
    for (int j = at[1] - search[1]; j <= at[1] + search[1]; ++j) {
      for (int i = at[0] - search[0]; i <= at[0] + search[0]; ++i) {
        const MaterialId m = image_.at_or_background(i, j, k);
        if (m != a && m != b) {
          continue;
        }
        const Vec3 to = frame.local_centre(i, j, k) - x;
        const double d = to.norm();
        double& nearest = m == a ? nearest_a : nearest_b;
        if (d < nearest) {
          nearest = d;
          (m == a ? to_a : to_b) = to;
        }
      }
    }
  }
  if (nearest_a == kInfinity || nearest_b == kInfinity) {
    return {.deviation_mm = kInfinity};
  }
  // Deep inside one of the two: the nearest voxel of the other shows the way.
  if (nearest_a < nearest_b) {
    const double distance = std::max(0.0, nearest_b - 0.5 * voxel_mm_);
    return {distance, -1 * to_b.normalized(), distance, false};
  }
  const double distance = std::max(0.0, nearest_a - 0.5 * voxel_mm_);
  return {-distance, to_a.normalized(), distance, false};
}

bool ImageDomain::all_meet_near(const Vec3& x, const MaterialSet& set, double distance_mm) const {
  const ImageFrame& frame = image_.frame;
  Index3 low;
  Index3 high;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    // Of needle or plate voxels no more than a few: hundreds lie within the distance along their short side.
    const double voxels = std::min(distance_mm / frame.spacing_mm[axis], 4.0);
    low[a] = static_cast<int>(std::floor(x[axis] / frame.spacing_mm[axis] - voxels));
    high[a] = static_cast<int>(std::floor(x[axis] / frame.spacing_mm[axis] + voxels));
  }
  std::array<std::uint8_t, MaterialSet::kCapacity> met{};  // bits of the materials that each has met
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j) {
      for (int i = low[0]; i <= high[0]; ++i) {
        unsigned here = 0;
        for (int c = 0; c < 8; ++c) {
          const MaterialId m = image_.at_or_background(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          for (std::uint8_t s = 0; s < set.size; ++s) {
            here |= set.ids[s] == m ? 1U << s : 0U;
          }
        }
        for (std::uint8_t s = 0; s < set.size; ++s) {
          met[s] = static_cast<std::uint8_t>(met[s] | ((here >> s & 1U) != 0 ? here : 0U));
        }
      }
    }
  }
  const auto all = static_cast<std::uint8_t>((1U << set.size) - 1U);
  return std::all_of(met.begin(), met.begin() + set.size, [all](std::uint8_t m) { return m == all; });
}

}  // namespace cbc3d
