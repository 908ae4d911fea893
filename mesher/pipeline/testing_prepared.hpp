// What the benchmarks work on: one three-material phantom at 1, 8 and 64 times the voxels.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d::bench {

inline constexpr int kSizes[] = {48, 96, 192};

/// Body, organ and a vessel through both, in the same proportions at every size; spacing 1 mm.
inline LabelImage phantom(int size) {
  const double s = size;
  return testing::make_image({size, size, size}, {1, 1, 1}, 3, [s](const Vec3& p) {
    const Vec3 q = p / s - Vec3{0.5, 0.5, 0.5};
    const bool vessel = std::hypot(q.y - 0.1, q.z) < 0.05 && std::abs(q.x) < 0.4;
    return vessel ? 3 : (q - Vec3{0.05, 0.1, 0}).norm() < 0.2 ? 2 : q.norm() < 0.42 ? 1 : 0;
  });
}

/// The image and what the stages make of it.
struct Prepared {
  LabelImage image;
  Lattice lattice;
  RefineResult refined;
  std::vector<Vec3> points;
  MaterialMesh mesh;
};

inline RefineOptions refine_options() {
  RefineOptions options;
  options.finest_spacing_mm = 1;
  return options;
}

inline const Prepared& prepared(int size) {
  static std::map<int, Prepared> cache;
  const auto [found, added] = cache.try_emplace(size);
  Prepared& p = found->second;
  if (added) {
    p.image = phantom(size);
    p.lattice = build_bcc_lattice(p.image, {10, 1});
    p.refined = refine_lattice(p.lattice, ImageDomain(p.image), refine_options(), [](int, std::size_t) {});
    p.points = local_points(p.lattice);
    p.mesh = discard_background(p.points, p.refined.mesh.tets.nodes, p.refined.mesh.materials);
  }
  return p;
}

inline void all_sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int size : kSizes) {
    benchmark->Arg(size);
  }
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace cbc3d::bench
