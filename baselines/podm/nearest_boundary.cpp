#include "baselines/podm/nearest_boundary.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::podm {
// The lower envelope of parabolas over one line: which apex is lowest from where on.
class NearestBoundary::Envelope {
 public:
  Envelope(int length, double step_mm) : step_mm_(step_mm) {
    apexes_.reserve(static_cast<std::size_t>(length));
  }

  void clear() { apexes_.clear(); }
  [[nodiscard]] bool empty() const { return apexes_.empty(); }

  // Adds the parabola height_mm2 + (step_mm (x - at))^2; `at` ascends.
  void add(int at, double height_mm2) {
    double from = -std::numeric_limits<double>::infinity();
    while (!apexes_.empty()) {
      from = overtakes(apexes_.back(), at, height_mm2);
      if (from > apexes_.back().from) break;
      apexes_.pop_back();
      from = -std::numeric_limits<double>::infinity();
    }
    apexes_.push_back({at, height_mm2, from});
  }

  // Calls visit(x, number of the apex) for all x of the line.
  template <typename Visit>
  void for_each(int length, Visit visit) const {
    std::size_t n = 0;
    for (int x = 0; x < length; ++x) {
      while (n + 1 < apexes_.size() && apexes_[n + 1].from < x) ++n;
      visit(x, n);
    }
  }

  // Keeps the features at the apexes.
  void keep(const Feature* line) {
    kept_.clear();
    for (const Apex& apex : apexes_) kept_.push_back(line[apex.at]);
  }
  [[nodiscard]] const Feature& kept(std::size_t apex) const { return kept_[apex]; }

 private:
  struct Apex {
    int at;
    double height_mm2, from;
  };

  [[nodiscard]] double overtakes(const Apex& p, int at, double height_mm2) const {
    const double square = step_mm_ * step_mm_;
    return 0.5 * ((height_mm2 - p.height_mm2) / (square * (at - p.at)) + at + p.at);
  }

  double step_mm_;
  std::vector<Apex> apexes_;
  std::vector<Feature> kept_;
};

namespace {

// Rows read their neighbours in the image where it has them, and background beyond.
std::uint8_t faces_of(const LabelImage& image, const Index3& at) {
  const Index3& n = image.frame.size;
  const std::size_t own_offset = image.frame.offset(at[0], at[1], at[2]);
  const MaterialId own = image.voxels[own_offset];
  const std::array<std::size_t, 3> strides{1, static_cast<std::size_t>(n[0]),
                                           static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1])};
  unsigned bits = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const MaterialId before = at[a] > 0 ? image.voxels[own_offset - strides[a]] : kBackground;
    const MaterialId after = at[a] + 1 < n[a] ? image.voxels[own_offset + strides[a]] : kBackground;
    bits |= (before != own ? 1U : 0U) << (2 * a) | (after != own ? 2U : 0U) << (2 * a);
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

NearestBoundary::NearestBoundary(const LabelImage& image) : frame_(image.frame) {
  for (const int n : frame_.size) {
    if (n >= kNone) {
      throw InputError("an image of " + std::to_string(n) +
                       " voxels along an axis is larger than podm can mesh: give at most 65534");
    }
  }
  find_box(image);
  if (!has_boundary_) return;
  find_faces(image);
  sweep_rows();
  sweep_axis(1);
  sweep_axis(2);
}

void NearestBoundary::find_box(const LabelImage& image) {
  const Index3& n = image.frame.size;
  int i0 = n[0], j0 = n[1], k0 = n[2], i1 = -1, j1 = -1, k1 = -1;
#pragma omp parallel for schedule(static) reduction(min : i0, j0, k0) reduction(max : i1, j1, k1)
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      const std::size_t row = image.frame.offset(0, j, k);
      int first = 0, last = n[0] - 1;
      while (first < n[0] && image.voxels[row + static_cast<std::size_t>(first)] == kBackground) ++first;
      if (first == n[0]) continue;
      while (image.voxels[row + static_cast<std::size_t>(last)] == kBackground) --last;
      i0 = std::min(i0, first), i1 = std::max(i1, last);
      j0 = std::min(j0, j), j1 = std::max(j1, j);
      k0 = std::min(k0, k), k1 = std::max(k1, k);
    }
  }
  has_boundary_ = k1 >= 0;
  first_ = {std::max(0, i0 - 1), std::max(0, j0 - 1), std::max(0, k0 - 1)};
  last_ = {std::min(n[0] - 1, i1 + 1), std::min(n[1] - 1, j1 + 1), std::min(n[2] - 1, k1 + 1)};
  for (std::size_t a = 0; a < 3; ++a) frame_.size[a] = last_[a] - first_[a] + 1;
}

void NearestBoundary::find_faces(const LabelImage& image) {
  faces_.resize(frame_.voxel_count());
#pragma omp parallel for schedule(static)
  for (int k = 0; k < frame_.size[2]; ++k) {
    for (int j = 0; j < frame_.size[1]; ++j) {
      for (int i = 0; i < frame_.size[0]; ++i)
        faces_[frame_.offset(i, j, k)] = faces_of(image, {i + first_[0], j + first_[1], k + first_[2]});
    }
  }
}

// Nearest boundary voxels within rows along x.
void NearestBoundary::sweep_rows() {
  features_.assign(frame_.voxel_count(), Feature{kNone, 0, 0});
#pragma omp parallel for schedule(static)
  for (int k = 0; k < frame_.size[2]; ++k) {
    for (int j = 0; j < frame_.size[1]; ++j) {
      const std::size_t row = frame_.offset(0, j, k);
      const auto set = [&](int i, int x) {
        features_[row + static_cast<std::size_t>(i)] = {
            static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(j), static_cast<std::uint16_t>(k)};
      };
      int last = -1;
      for (int i = 0; i < frame_.size[0]; ++i) {
        if (faces_[row + static_cast<std::size_t>(i)] != 0) last = i;
        if (last >= 0) set(i, last);
      }
      int next = -1;
      for (int i = frame_.size[0] - 1; i >= 0; --i) {
        const std::uint16_t before = features_[row + static_cast<std::size_t>(i)][0];
        if (faces_[row + static_cast<std::size_t>(i)] != 0) next = i;
        if (next >= 0 && (before == kNone || next - i < i - before)) set(i, next);
      }
    }
  }
}

// Replaces the features of one line, which runs through `at` along `axis`.
void NearestBoundary::sweep_line(Envelope& envelope, Feature* line, Index3 at, std::size_t axis) const {
  const int length = frame_.size[axis];
  envelope.clear();
  for (at[axis] = 0; at[axis] < length; ++at[axis]) {
    const Feature& feature = line[at[axis]];
    if (feature[0] != kNone) envelope.add(at[axis], height(feature, at, axis));
  }
  if (envelope.empty()) return;
  // An apex may lie before or behind the places it is nearest to, so they are read before they are written.
  envelope.keep(line);
  envelope.for_each(length, [&](int x, std::size_t apex) { line[x] = envelope.kept(apex); });
}

// The squared distance along the axes before `axis`.
double NearestBoundary::height(const Feature& feature, const Index3& at, std::size_t axis) const {
  double sum = 0;
  for (std::size_t a = 0; a < axis; ++a) {
    const double d = frame_.spacing_mm[static_cast<int>(a)] * (at[a] - static_cast<int>(feature[a]));
    sum += d * d;
  }
  return sum;
}

// Lines beside each other are swept together, since their voxels lie beside each other in memory.
void NearestBoundary::sweep_axis(std::size_t axis) {
  const std::size_t across = axis == 1 ? 2 : 1;
  const int length = frame_.size[axis];
  constexpr int kTogether = 16;
#pragma omp parallel
  {
    Envelope envelope(length, frame_.spacing_mm[static_cast<int>(axis)]);
    std::vector<Feature> lines(static_cast<std::size_t>(length) * kTogether);
    const auto line = [&](int a, int x) -> Feature& {
      return lines[static_cast<std::size_t>(a % kTogether) * static_cast<std::size_t>(length) +
                   static_cast<std::size_t>(x)];
    };
#pragma omp for schedule(static)
    for (int b = 0; b < frame_.size[across]; ++b) {
      for (int low = 0; low < frame_.size[0]; low += kTogether) {
        const int high = std::min(low + kTogether, frame_.size[0]);
        Index3 at{low, b, b};
        for (at[axis] = 0; at[axis] < length; ++at[axis]) {
          const Feature* row = &features_[frame_.offset(low, at[1], at[2])];
          for (int a = low; a < high; ++a) line(a, at[axis]) = row[a - low];
        }
        for (at[0] = low; at[0] < high; ++at[0]) sweep_line(envelope, &line(at[0], 0), at, axis);
        for (at[axis] = 0; at[axis] < length; ++at[axis]) {
          Feature* row = &features_[frame_.offset(low, at[1], at[2])];
          for (int a = low; a < high; ++a) row[a - low] = line(a, at[axis]);
        }
      }
    }
  }
}

}  // namespace cbc3d::baselines::podm
