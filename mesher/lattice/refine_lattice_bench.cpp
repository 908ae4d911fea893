// The adaptive refinement.
#include <benchmark/benchmark.h>

#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void AdaptiveRefinement(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const ImageDomain domain(p.image);
  const Lattice coarse = build_bcc_lattice(p.image, {10, 1});
  for (auto _ : state) {
    Lattice lattice = coarse;
    benchmark::DoNotOptimize(refine_lattice(lattice, domain, refine_options(), [](int, std::size_t) {}));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

BENCHMARK(AdaptiveRefinement)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
