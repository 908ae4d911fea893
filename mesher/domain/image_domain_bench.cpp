// The boundary field at every boundary voxel.
#include <benchmark/benchmark.h>

#include <vector>

#include "mesher/domain/image_domain.hpp"
#include "mesher/testing/bandwidth.hpp"
#include "mesher/testing/benchmarks.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// One sample at the face of every boundary voxel; 64 voxels, a point and a sample each.
void KernelBoundaryField(benchmark::State& state) {
  const LabelImage& image = image_of(state);
  const ImageDomain domain(image);
  const std::vector<BoundarySample>& samples = domain.samples();
  std::vector<double> distance_mm(samples.size());
  for ([[maybe_unused]] const auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < samples.size(); ++p) {
      distance_mm[p] =
          domain.boundary_distance(samples[p].centre(), samples[p].own, samples[p].other).distance_mm;
    }
    benchmark::DoNotOptimize(distance_mm.data());
  }
  const auto count = static_cast<double>(samples.size());
  count_work(state, count, count * (64 + sizeof(BoundarySample) + sizeof(double)));
}

BENCHMARK(KernelBoundaryField)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
