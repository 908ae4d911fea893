// The topological checks.
#include <benchmark/benchmark.h>

#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void TopologyChecks(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const ImageDomain domain(p.image);
  for (auto _ : state) {
    CandidateMesh mesh = p.refined.mesh;
    benchmark::DoNotOptimize(check_topology(mesh, p.points, domain, {}));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

BENCHMARK(TopologyChecks)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
