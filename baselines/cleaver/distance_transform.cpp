#include "baselines/cleaver/distance_transform.hpp"

#include <algorithm>
#include <cmath>

namespace cbc3d::baselines::cleaver {
namespace {

struct Envelope {
  std::vector<std::int64_t> heights;
  std::vector<int> apex;
  std::vector<double> from;

  explicit Envelope(int length)
      : heights(static_cast<std::size_t>(length)),
        apex(static_cast<std::size_t>(length)),
        from(static_cast<std::size_t>(length) + 1) {}

  // Where the parabola of apex q falls below that of apex p, p < q.
  [[nodiscard]] double overtakes(int p, int q) const {
    const double hp = static_cast<double>(heights[static_cast<std::size_t>(p)]) + static_cast<double>(p) * p;
    const double hq = static_cast<double>(heights[static_cast<std::size_t>(q)]) + static_cast<double>(q) * q;
    return (hq - hp) / (2.0 * (q - p));
  }

  // Transforms one line of `length` values at steps of `stride`.
  void run(std::uint16_t* line, int length, std::size_t stride) {
    int last = -1;
    for (int q = 0; q < length; ++q) {
      const std::uint16_t value = line[static_cast<std::size_t>(q) * stride];
      heights[static_cast<std::size_t>(q)] = value;
      if (value == kFarSquared) continue;
      double start = -1e300;
      while (last >= 0) {
        start = overtakes(apex[static_cast<std::size_t>(last)], q);
        if (start > from[static_cast<std::size_t>(last)]) break;
        --last;
        start = -1e300;
      }
      ++last;
      apex[static_cast<std::size_t>(last)] = q;
      from[static_cast<std::size_t>(last)] = start;
    }
    if (last < 0) return;
    int n = 0;
    for (int q = 0; q < length; ++q) {
      while (n < last && from[static_cast<std::size_t>(n) + 1] < q) ++n;
      const int p = apex[static_cast<std::size_t>(n)];
      const std::int64_t step = q - p;
      const std::int64_t value = heights[static_cast<std::size_t>(p)] + step * step;
      line[static_cast<std::size_t>(q) * stride] =
          static_cast<std::uint16_t>(std::min<std::int64_t>(value, kFarSquared));
    }
  }
};

// Transforms all lines along one axis.
void transform_axis(CellArray<std::uint16_t>& values, std::size_t axis) {
  const Index3& size = values.size;
  const std::size_t other[3][2] = {{1, 2}, {0, 2}, {0, 1}};
  const std::size_t strides[3] = {1, static_cast<std::size_t>(size[0]),
                                  static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1])};
  const std::size_t inner = other[axis][0], outer = other[axis][1];
#pragma omp parallel
  {
    Envelope envelope(size[axis]);
#pragma omp for schedule(static)
    for (int b = 0; b < size[outer]; ++b) {
      for (int a = 0; a < size[inner]; ++a) {
        std::uint16_t* line = values.values.data() + static_cast<std::size_t>(a) * strides[inner] +
                              static_cast<std::size_t>(b) * strides[outer];
        envelope.run(line, size[axis], strides[axis]);
      }
    }
  }
}

}  // namespace

void squared_distances(CellArray<std::uint16_t>& values) {
  for (std::size_t axis = 0; axis < 3; ++axis) transform_axis(values, axis);
}

}  // namespace cbc3d::baselines::cleaver
