// The table of vertices.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// All vertices of a lattice put into a table, then each of them found; serial, as the lattice's is filled.
void KernelVertexTable(benchmark::State& state) {
  const std::vector<LatticePoint>& points = prepared(state).lattice.points;
  for ([[maybe_unused]] const auto _ : state) {
    VertexTable table;
    VertexId next = 0;
    for (const LatticePoint& point : points) {
      next += table.find_or_insert(point, next) == next ? 1 : 0;
    }
    VertexId last = 0;
    for (const LatticePoint& point : points) {
      last = std::max(last, table.find(point));
    }
    benchmark::DoNotOptimize(last);
  }
  constexpr double kSlotBytes = 16;
  const auto count = static_cast<double>(points.size());
  count_work(state, 2 * count, 2 * count * (sizeof(LatticePoint) + kSlotBytes));
}

BENCHMARK(KernelVertexTable)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
