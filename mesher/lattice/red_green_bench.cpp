// The conforming mesh of a lattice.
#include <benchmark/benchmark.h>

#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void ExtractTets(benchmark::State& state) {
  const Prepared& p = prepared(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(extract_tets(p.lattice));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

BENCHMARK(ExtractTets)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
