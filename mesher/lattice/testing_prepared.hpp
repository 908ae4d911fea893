// The benchmarks' phantom with what the lattice's stages make of it.
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <vector>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/testing/benchmarks.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d::bench {

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
    p.image = image_of(size);
    p.lattice = build_bcc_lattice(p.image, {10, 1});
    p.refined = refine_lattice(p.lattice, ImageDomain(p.image), refine_options(), [](int, std::size_t) {});
    p.points = local_points(p.lattice);
    p.mesh = discard_background(p.points, p.refined.mesh.tets.nodes, p.refined.mesh.materials);
  }
  return p;
}

inline const Prepared& prepared(const benchmark::State& state) {
  return prepared(static_cast<int>(state.range(0)));
}

}  // namespace cbc3d::bench
