// Displacements of the sources.
#include <benchmark/benchmark.h>

#include <cstdint>

#include "mesher/deform/source_displacements.hpp"
#include "mesher/deform/testing_parts.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void SourceDisplacements(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const Parts parts(p);
  cbc3d::SourceDisplacements asked({parts.sources, parts.targets, parts.sets, p.image.frame}, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(asked.at(p.mesh.points));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(parts.sources.sources.size()));
}

BENCHMARK(SourceDisplacements)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
