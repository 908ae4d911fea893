// The deformation's system, assembled and solved.
#include <benchmark/benchmark.h>

#include <vector>

#include "mesher/deform/elasticity.hpp"
#include "mesher/deform/testing_parts.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void AssembleStiffness(benchmark::State& state) {
  const Prepared& p = prepared(state);
  Parts parts(p);
  for (auto _ : state) {
    parts.system.assemble(p.mesh, parts.is_source);
  }
  count_tets(state, p.mesh.tets.size());
}

void SolveSystem(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const Parts parts(p);
  int iterations = 0;
  for (auto _ : state) {
    std::vector<Vec3> u(p.mesh.points.size());
    iterations = parts.system.solve(parts.load, u).iterations;
    benchmark::DoNotOptimize(u.data());
  }
  state.counters["cg_iterations"] = iterations;
  count_tets(state, p.mesh.tets.size());
}

BENCHMARK(AssembleStiffness)->Apply(all_sizes);
BENCHMARK(SolveSystem)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
