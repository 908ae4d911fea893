// The solver's matrix times a vector.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "mesher/deform/elasticity.hpp"
#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// The solver's matrix of 3x3 blocks (nine floats and a column) times a vector.
void KernelMatrixVector(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const VertexCells around = cells_of_vertices(p.mesh);
  ElasticSystem system(p.mesh, around, std::vector<ElasticMaterial>(p.image.labels.size()), {});
  system.assemble(p.mesh, std::vector<std::uint8_t>(p.mesh.points.size(), 1));
  const BlockMatrix& matrix = system.matrix();
  const std::vector<Float4> x(p.mesh.points.begin(), p.mesh.points.end());
  std::vector<Float4> y(x.size());
  for ([[maybe_unused]] const auto _ : state) {
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t v = 0; v < y.size(); ++v) {
      y[v] = matrix.row_times(static_cast<VertexId>(v), x);
    }
    benchmark::DoNotOptimize(y.data());
  }
  std::size_t blocks = 0;
  for (std::size_t v = 0; v < y.size(); ++v) blocks += matrix.columns(static_cast<VertexId>(v)).size();
  count_work(state, static_cast<double>(blocks),
             static_cast<double>(blocks * (9 * sizeof(float) + sizeof(VertexId)) +
                                 y.size() * (2 * sizeof(Float4) + sizeof(std::uint64_t))));
}

BENCHMARK(KernelMatrixVector)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
