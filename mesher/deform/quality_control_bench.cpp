// The quality control of all cells.
#include <benchmark/benchmark.h>

#include "mesher/deform/quality_control.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void CheckQuality(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const VertexCells around = cells_of_vertices(p.mesh);
  const QualityControl quality(p.mesh, around, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(quality.failing(p.mesh.points, p.mesh.points));
  }
  count_tets(state, p.mesh.tets.size());
}

BENCHMARK(CheckQuality)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
