// One sweep of the relaxation.
#include <benchmark/benchmark.h>

#include <vector>

#include "mesher/domain/image_domain.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/lattice/testing_prepared.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

/// One sweep of the improvement's relaxation over all vertices, cutting the mesh in patches included.
void KernelRelaxation(benchmark::State& state) {
  const Prepared& p = prepared(state);
  const double diagonal_mm = p.image.frame.voxel_diagonal_mm();
  const ImageDomain domain(p.image);
  const std::vector<BoundarySample> none;
  const PatchRules rules{.boundaries = {domain},
                         .guards = {0.15 * diagonal_mm, diagonal_mm},
                         .samples = none,
                         .reach_mm = 0.9 * diagonal_mm};
  for ([[maybe_unused]] const auto _ : state) {
    MaterialMesh mesh = p.mesh;
    std::vector<VertexId> covering;
    improve_in_patches(mesh, covering, rules, 0, [](Patch& patch) { relax_vertices(patch, {1000, 0.5, 0}); });
    benchmark::DoNotOptimize(mesh.points.data());
  }
  const auto vertices = static_cast<double>(p.mesh.points.size());
  count_work(state, vertices,
             2 * vertices * sizeof(Vec3) + static_cast<double>(p.mesh.tets.size() * sizeof(p.mesh.tets[0])));
}

BENCHMARK(KernelRelaxation)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
