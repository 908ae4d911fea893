#include "baselines/podm/nearest_boundary.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines::podm {
namespace {

// The lower envelope of parabolas over one line: which apex is lowest from where on.
class Envelope {
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

  // Calls visit(x, apex) for all x of the line.
  template <typename Visit>
  void for_each(int length, Visit visit) const {
    std::size_t n = 0;
    for (int x = 0; x < length; ++x) {
      while (n + 1 < apexes_.size() && apexes_[n + 1].from < x) ++n;
      visit(x, apexes_[n].at);
    }
  }

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
};

std::uint8_t faces_of(const LabelImage& image, const Index3& at) {
  const MaterialId own = image.at(at[0], at[1], at[2]);
  unsigned bits = 0;
  for (std::size_t f = 0; f < 6; ++f) {
    const Index3& step = kFaceSteps[f];
    if (image.at_or_background(at[0] + step[0], at[1] + step[1], at[2] + step[2]) != own) bits |= 1U << f;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

NearestBoundary::NearestBoundary(const LabelImage& image) : frame_(image.frame) {
  for (const int n : frame_.size) {
    if (n >= kNone)
      throw InputError("an image of " + std::to_string(n) +
                       " voxels along an axis is larger than podm can mesh: give at most 65534");
  }
  find_faces(image);
  if (!has_boundary_) return;
  sweep_rows();
  sweep_axis(1);
  sweep_axis(2);
}

void NearestBoundary::find_faces(const LabelImage& image) {
  faces_.assign(frame_.voxel_count(), 0);
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (int k = 0; k < frame_.size[2]; ++k) {
    for (int j = 0; j < frame_.size[1]; ++j) {
      for (int i = 0; i < frame_.size[0]; ++i) {
        const std::uint8_t bits = faces_of(image, {i, j, k});
        faces_[frame_.offset(i, j, k)] = bits;
        any = any || bits != 0;
      }
    }
  }
  has_boundary_ = any;
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

// The squared distance along the axes before `axis`.
double NearestBoundary::height(const Feature& feature, const Index3& at, std::size_t axis) const {
  double sum = 0;
  for (std::size_t a = 0; a < axis; ++a) {
    const double d = frame_.spacing_mm[static_cast<int>(a)] * (at[a] - static_cast<int>(feature[a]));
    sum += d * d;
  }
  return sum;
}

void NearestBoundary::sweep_axis(std::size_t axis) {
  const std::size_t across = axis == 1 ? 2 : 1;
  const int length = frame_.size[axis];
#pragma omp parallel
  {
    Envelope envelope(length, frame_.spacing_mm[static_cast<int>(axis)]);
    std::vector<Feature> line(static_cast<std::size_t>(length));
#pragma omp for schedule(static)
    for (int b = 0; b < frame_.size[across]; ++b) {
      for (int a = 0; a < frame_.size[0]; ++a) {
        Index3 at{a, b, b};
        envelope.clear();
        for (at[axis] = 0; at[axis] < length; ++at[axis]) {
          const Feature& feature = line[static_cast<std::size_t>(at[axis])] = features_[offset(at)];
          if (feature[0] != kNone) envelope.add(at[axis], height(feature, at, axis));
        }
        if (envelope.empty()) continue;
        envelope.for_each(length, [&](int x, int apex) {
          at[axis] = x;
          features_[offset(at)] = line[static_cast<std::size_t>(apex)];
        });
      }
    }
  }
}

}  // namespace cbc3d::baselines::podm
