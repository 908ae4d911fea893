// The boundary field at every boundary voxel.
#include <benchmark/benchmark.h>

#include <vector>

#include "mesher/domain/image_boundary.hpp"
#include "mesher/domain/interface_points.hpp"
#include "mesher/testing/bandwidth.hpp"
#include "mesher/testing/benchmarks.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// One sample at the face of every boundary voxel; 64 voxels, a point and a sample each.
void KernelBoundaryField(benchmark::State& state) {
  const LabelImage& image = image_of(state);
  const ImageBoundary boundary(image, {});
  const std::vector<InterfacePoint> points = interface_points(image);
  std::vector<double> distance_mm(points.size());
  for ([[maybe_unused]] const auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < points.size(); ++p) {
      distance_mm[p] = boundary.sample(points[p].centre(), points[p].own, points[p].other).distance_mm;
    }
    benchmark::DoNotOptimize(distance_mm.data());
  }
  const auto count = static_cast<double>(points.size());
  count_work(state, count, count * (64 + sizeof(InterfacePoint) + sizeof(double)));
}

BENCHMARK(KernelBoundaryField)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
