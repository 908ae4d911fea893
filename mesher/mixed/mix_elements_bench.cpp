// Mixed elements.
#include <benchmark/benchmark.h>

#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/mixed/mix_elements.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void MixElements(benchmark::State& state) {
  const Prepared& p = prepared(state);
  for (auto _ : state) {
    MaterialMesh mesh = p.mesh;
    benchmark::DoNotOptimize(mix_elements(mesh, {}));
  }
  count_tets(state, p.mesh.tets.size());
}

BENCHMARK(MixElements)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
