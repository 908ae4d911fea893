// A benchmark per stage, on one three-material phantom at 1, 8 and 64 times the voxels (the argument is the
// size along an axis). Bytes and items per second are counted in voxels for the image's stages and in tets
// for the mesh's.
#include <benchmark/benchmark.h>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/check_topology.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/mixed/mix_elements.hpp"
#include "mesher/pipeline/testing_prepared.hpp"
#include "mesher/preprocess/clean_image.hpp"

namespace cbc3d {
namespace {

using namespace bench;

void count_voxels(benchmark::State& state, const LabelImage& image) {
  const auto voxels = static_cast<std::int64_t>(image.voxels.size());
  state.SetItemsProcessed(state.iterations() * voxels);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(image.voxels.bytes()));
}

void count_tets(benchmark::State& state, std::size_t tets) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tets));
}

void CleanImage(benchmark::State& state) {
  const LabelImage& image = prepared(static_cast<int>(state.range(0))).image;
  CleanOptions options;
  options.relabel_noise = NoisyVoxels::both;
  for (auto _ : state) {
    LabelImage copy = image;
    benchmark::DoNotOptimize(clean_image(copy, options, true));
  }
  count_voxels(state, image);
}

void BccLattice(benchmark::State& state) {
  const LabelImage& image = prepared(static_cast<int>(state.range(0))).image;
  for (auto _ : state) {
    benchmark::DoNotOptimize(build_bcc_lattice(image, {10, 1}));
  }
  count_voxels(state, image);
}

void AdaptiveRefinement(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const Lattice coarse = build_bcc_lattice(p.image, {10, 1});
  for (auto _ : state) {
    Lattice lattice = coarse;
    benchmark::DoNotOptimize(
        refine_lattice(lattice, ImageDomain(p.image), refine_options(), [](int, std::size_t) {}));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

void ExtractTets(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(extract_tets(p.lattice));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

void TetNeighbours(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(tet_neighbours(p.refined.mesh.tets.nodes, p.points.size()));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

void TopologyChecks(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    CandidateMesh mesh = p.refined.mesh;
    benchmark::DoNotOptimize(check_topology(mesh, p.points, ImageDomain(p.image), {}));
  }
  count_tets(state, p.refined.mesh.tets.size());
}

void Deformation(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  DeformOptions options;
  options.iterations = 1;
  for (auto _ : state) {
    MaterialMesh mesh = p.mesh;
    benchmark::DoNotOptimize(deform_mesh(mesh, p.image, options, [](int) {}));
  }
  count_tets(state, p.mesh.tets.size());
}

/// The deformation's parts on one mesh.
struct Parts {
  explicit Parts(const Prepared& p)
      : around(cells_of_vertices(p.mesh)),
        sources(extract_source_points(p.mesh, around, sets)),
        targets(extract_target_points(p.image, Connectivity::no, sets)),
        system(p.mesh, around, std::vector<ElasticMaterial>(p.image.labels.size()), {}),
        is_source(p.mesh.points.size(), 0),
        load(p.mesh.points.size()) {
    const auto found =
        cbc3d::SourceDisplacements({sources, targets, sets, p.image.frame}, {}).at(p.mesh.points);
    for (std::size_t s = 0; s < found.size(); ++s) {
      is_source[sources.sources[s].vertex] = found[s].matched ? 1 : 0;
      load[sources.sources[s].vertex] = found[s].vector;
    }
    system.assemble(p.mesh, is_source);
  }
  VertexCells around;
  MaterialSets sets;
  SourcePoints sources;
  TargetPoints targets;
  ElasticSystem system;
  std::vector<std::uint8_t> is_source;
  std::vector<Vec3> load;
};

void MixElements(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    MaterialMesh mesh = p.mesh;
    benchmark::DoNotOptimize(mix_elements(mesh, {}));
  }
  count_tets(state, p.mesh.tets.size());
}

void ExtractPoints(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    MaterialSets sets;
    const VertexCells around = cells_of_vertices(p.mesh);
    benchmark::DoNotOptimize(extract_source_points(p.mesh, around, sets));
    benchmark::DoNotOptimize(extract_target_points(p.image, Connectivity::no, sets));
  }
  count_voxels(state, p.image);
}

void SourceDisplacements(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const Parts parts(p);
  cbc3d::SourceDisplacements asked({parts.sources, parts.targets, parts.sets, p.image.frame}, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(asked.at(p.mesh.points));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(parts.sources.sources.size()));
}

void AssembleStiffness(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  Parts parts(p);
  for (auto _ : state) {
    parts.system.assemble(p.mesh, parts.is_source);
  }
  count_tets(state, p.mesh.tets.size());
}

void SolveSystem(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
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

void CheckQuality(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const VertexCells around = cells_of_vertices(p.mesh);
  const QualityControl quality(p.mesh, around, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(quality.failing(p.mesh.points, p.mesh.points));
  }
  count_tets(state, p.mesh.tets.size());
}

BENCHMARK(CleanImage)->Apply(all_sizes);
BENCHMARK(BccLattice)->Apply(all_sizes);
BENCHMARK(AdaptiveRefinement)->Apply(all_sizes);
BENCHMARK(ExtractTets)->Apply(all_sizes);
BENCHMARK(TetNeighbours)->Apply(all_sizes);
BENCHMARK(TopologyChecks)->Apply(all_sizes);
BENCHMARK(MixElements)->Apply(all_sizes);
BENCHMARK(ExtractPoints)->Apply(all_sizes);
BENCHMARK(SourceDisplacements)->Apply(all_sizes);
BENCHMARK(AssembleStiffness)->Apply(all_sizes);
BENCHMARK(SolveSystem)->Apply(all_sizes);
BENCHMARK(CheckQuality)->Apply(all_sizes);
BENCHMARK(Deformation)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d

BENCHMARK_MAIN();
