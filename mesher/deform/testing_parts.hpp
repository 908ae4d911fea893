// The deformation's parts on the benchmarks' mesh.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <vector>

#include "mesher/deform/elasticity.hpp"
#include "mesher/deform/source_displacements.hpp"
#include "mesher/lattice/testing_prepared.hpp"

namespace cbc3d::bench {

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

}  // namespace cbc3d::bench
