// Voxels in the tets of a lattice.
#include <benchmark/benchmark.h>

#include <array>

#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// The labelled voxels in every red tet of the lattice.
void KernelVoxelRaster(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const VoxelRaster raster(p.image.frame, p.lattice.frame);
  const auto labelled_in = [&](const RedTet& red) {
    std::size_t found = 0;
    const std::array<LatticePoint, 4> corners{p.lattice.points[red.nodes[0]], p.lattice.points[red.nodes[1]],
                                              p.lattice.points[red.nodes[2]], p.lattice.points[red.nodes[3]]};
    raster.for_each_row(corners, [&](int j, int k, int begin, int end) {
      const std::size_t row = p.image.frame.offset(0, j, k);
      for (int i = begin; i < end; ++i) {
        found += p.image.voxels[row + static_cast<std::size_t>(i)] != kBackground ? 1 : 0;
      }
    });
    return found;
  };
  for ([[maybe_unused]] const auto _ : state) {
    std::size_t labelled = 0;
#pragma omp parallel for schedule(dynamic, 256) reduction(+ : labelled)
    for (std::size_t t = 0; t < p.lattice.reds.size(); ++t) {
      labelled += labelled_in(p.lattice.reds[t]);
    }
    benchmark::DoNotOptimize(labelled);
  }
  count_work(state, voxel_count(p.image),
             voxel_bytes(p.image) + static_cast<double>(p.lattice.reds.size() * sizeof(RedTet)));
}

BENCHMARK(KernelVoxelRaster)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
