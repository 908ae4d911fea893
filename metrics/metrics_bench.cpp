// What the metrics cost. A ball with a core of its own label: image of `size` voxels a side, mesh of tets of
// the body-centred cubic lattice with size / 5.25 cells a side (a million tets against thirty million voxels
// at 311).
#include <benchmark/benchmark.h>

#include "mesher/testing/bandwidth.hpp"
#include "metrics/element_quality.hpp"
#include "metrics/image_topology.hpp"
#include "metrics/mesh_betti.hpp"
#include "metrics/point_set_hausdorff.hpp"
#include "metrics/self_intersection.hpp"
#include "metrics/smooth_surface.hpp"
#include "metrics/surface_hausdorff.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kVoxelsPerCell = 5.25;

// 0 outside, 1 shell, 2 core.
MaterialId material_at(const Vec3& p, double size) {
  const double radius = (p - .5 * size * Vec3{1, 1, 1}).norm() / size;
  return radius < .2 ? 2 : radius < .46 ? 1 : 0;
}

LabelImage ball_image(int size) {
  LabelImage image = test::empty_image({size, size, size}, {1, 1, 1}, {0, 1, 2});
#pragma omp parallel for
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels[v] = material_at(image.frame.local_centre(at[0], at[1], at[2]), size);
  }
  return image;
}

Mesh ball_mesh(int size) {
  const int cells = static_cast<int>(size / kVoxelsPerCell);
  const Mesh block = test::bcc_block(cells, static_cast<double>(size) / cells, 1);
  Mesh mesh;
  mesh.points = block.points;
  for (const auto& tet : block.tets.nodes) {
    Vec3 centre{};
    for (const VertexId v : tet) centre += .25 * block.points[v];
    if (const MaterialId m = material_at(centre, size); m != kBackground) mesh.tets.add(tet, m);
  }
  return mesh;
}

void report(benchmark::State& state, const Mesh& mesh, const LabelImage& image) {
  state.counters["tets"] = static_cast<double>(mesh.tets.size());
  state.counters["voxels"] = static_cast<double>(image.voxels.size());
}

void evaluate_all(benchmark::State& state, const EvaluateOptions& options) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = ball_image(size);
  const Mesh mesh = ball_mesh(size);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(test::judge(mesh, image, options));
  report(state, mesh, image);
}

void Evaluate(benchmark::State& state) {
  evaluate_all(state, {true, false});
}
void EvaluateCertified(benchmark::State& state) {
  evaluate_all(state, {true, true});
}

void ElementQuality(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = test::empty_image({1, 1, 1}, {1, 1, 1}, {0, 1, 2});
  const Mesh mesh = ball_mesh(size);
  const MeshView view(mesh, image);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(element_quality(view));
  report(state, mesh, image);
}

void MeshBettiNumbers(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = test::empty_image({1, 1, 1}, {1, 1, 1}, {0, 1, 2});
  const Mesh mesh = ball_mesh(size);
  const MeshView view(mesh, image);
  const auto facets = sorted_facets(view);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(mesh_betti(view, facets));
  report(state, mesh, image);
}

void SurfaceSelfIntersections(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = test::empty_image({1, 1, 1}, {1, 1, 1}, {0, 1, 2});
  const Mesh mesh = ball_mesh(size);
  const MeshView view(mesh, image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(self_intersections(view, surface));
  report(state, mesh, image);
  state.counters["facets"] = static_cast<double>(surface.facets.size());
}

void ImageBettiNumbers(benchmark::State& state) {
  const LabelImage image = ball_image(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(image_topology(image));
  report(state, {}, image);
}

void SmoothSurface(benchmark::State& state) {
  const LabelImage image = ball_image(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(smooth_surface(image, 1));
  report(state, {}, image);
}

void CertifiedDistance(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = ball_image(size);
  const Mesh mesh = ball_mesh(size);
  const MeshView view(mesh, image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  const auto faces = searchable_voxel_faces(image_boundaries(image)[1].faces, image.frame);
  const auto facets = searchable_facets(surface, surface.facets_of[0], view.local_points());
  const CertifyOptions options{kRelativeTolerance};
  for ([[maybe_unused]] const auto _ : state)
    benchmark::DoNotOptimize(surface_distance(faces, facets, options));
  report(state, mesh, image);
}

/// The paper's distance of one material: each point of either set read once, its nearest beside it.
void KernelPointSetDistance(benchmark::State& state) {
  const auto size = static_cast<int>(state.range(0));
  const LabelImage image = ball_image(size);
  const Mesh mesh = ball_mesh(size);
  const MeshView view(mesh, image);
  const std::vector<Vec3> boundary = image_boundaries(image)[1].voxel_centres;
  const Surface facets = extract_surface(view, sorted_facets(view));
  std::vector<Vec3> surface;
  for (const VertexId v : facets.vertices_of[0]) surface.push_back(view.local_points()[v]);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(point_set_distance(boundary, surface));
  const auto points = static_cast<double>(boundary.size() + surface.size());
  bench::count_work(state, points, 2 * points * sizeof(Vec3));
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(48)
      ->Arg(128)
      ->Arg(200)
      ->Arg(311)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

BENCHMARK(bench::stream_copy)->Name("KernelStreamCopy")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(bench::stream_triad)->Name("KernelStreamTriad")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(KernelPointSetDistance)->Apply(sizes);
BENCHMARK(Evaluate)->Apply(sizes);
BENCHMARK(EvaluateCertified)->Apply(sizes);
BENCHMARK(ElementQuality)->Apply(sizes);
BENCHMARK(MeshBettiNumbers)->Apply(sizes);
BENCHMARK(SurfaceSelfIntersections)->Apply(sizes);
BENCHMARK(ImageBettiNumbers)->Apply(sizes);
BENCHMARK(SmoothSurface)->Apply(sizes);
BENCHMARK(CertifiedDistance)->Apply(sizes);

}  // namespace
}  // namespace cbc3d::metrics

BENCHMARK_MAIN();
