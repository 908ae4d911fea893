// Neighbours of the tets of the candidate mesh.
#include <benchmark/benchmark.h>

#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/testing/bandwidth.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void KernelTetNeighbours(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const TetNodes& tets = p.refined.mesh.tets.nodes;
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(tet_neighbours(tets, p.points.size()));
  }
  const auto count = static_cast<double>(tets.size());
  count_work(state, count, count * (sizeof(tets[0]) + 4 * sizeof(TetId)));
}

void TetNeighbours(benchmark::State& state) {
  const Prepared& p = prepared(state);
  for (auto _ : state) {
    benchmark::DoNotOptimize(tet_neighbours(p.refined.mesh.tets.nodes, p.points.size()));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

BENCHMARK(KernelTetNeighbours)->Apply(all_sizes);
BENCHMARK(TetNeighbours)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
