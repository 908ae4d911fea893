// The coarse lattice.
#include <benchmark/benchmark.h>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void KernelBccLattice(benchmark::State& state) {
  const Prepared& p = prepared(state);
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(build_bcc_lattice(p.image, {10, 1}));
  }
  count_work(state, voxel_count(p.image), voxel_bytes(p.image));
}

void BccLattice(benchmark::State& state) {
  const LabelImage& image = image_of(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(build_bcc_lattice(image, {10, 1}));
  }
  count_voxels(state, image);
}

BENCHMARK(KernelBccLattice)->Apply(all_sizes);
BENCHMARK(BccLattice)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
