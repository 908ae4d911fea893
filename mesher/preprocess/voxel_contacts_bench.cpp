// The scan for contacts of voxels.
#include <benchmark/benchmark.h>

#include "mesher/preprocess/voxel_contacts.hpp"
#include "mesher/testing/bandwidth.hpp"
#include "mesher/testing/benchmarks.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void KernelCleaningScan(benchmark::State& state) {
  const LabelImage& image = image_of(state);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(count_voxel_contacts(image));
  count_work(state, voxel_count(image), voxel_bytes(image));
}

BENCHMARK(KernelCleaningScan)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
