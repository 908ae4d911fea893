// Sources and targets.
#include <benchmark/benchmark.h>

#include "mesher/deform/deformation_points.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void ExtractPoints(benchmark::State& state) {
  const Prepared& p = prepared(state);
  for (auto _ : state) {
    MaterialSets sets;
    const VertexCells around = cells_of_vertices(p.mesh);
    benchmark::DoNotOptimize(extract_source_points(p.mesh, around, sets));
    benchmark::DoNotOptimize(extract_target_points(p.image, Connectivity::no, sets));
  }
  count_voxels(state, p.image);
}

BENCHMARK(ExtractPoints)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
