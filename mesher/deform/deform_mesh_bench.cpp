// One iteration of the deformation.
#include <benchmark/benchmark.h>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void Deformation(benchmark::State& state) {
  const Prepared& p = prepared(state);
  DeformOptions options;
  options.iterations = 1;
  for (auto _ : state) {
    MaterialMesh mesh = p.mesh;
    benchmark::DoNotOptimize(deform_mesh(mesh, p.image, options, [](int) {}));
  }
  count_tets(state, p.mesh.tets.size());
}

BENCHMARK(Deformation)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
