// The cleaning as a whole.
#include <benchmark/benchmark.h>

#include "mesher/preprocess/clean_image.hpp"
#include "mesher/testing/benchmarks.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void CleanImage(benchmark::State& state) {
  const LabelImage& image = image_of(state);
  CleanOptions options;
  options.relabel_noise = NoisyVoxels::both;
  for (auto _ : state) {
    LabelImage copy = image;
    benchmark::DoNotOptimize(clean_image(copy, options, true));
  }
  count_voxels(state, image);
}

BENCHMARK(CleanImage)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
