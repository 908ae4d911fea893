// Lattice meshes of small images, and what must hold of them.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "baselines/ld/initial_mesh.hpp"
#include "baselines/ld/mesh_parts.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d::baselines::ld::testing {

/// The initial mesh of all blocks together.
inline LatticeMesh whole_initial_mesh(const CellGrid& grid, const InitialMeshOptions& options = {}) {
  const LabelOctree octree(grid);
  std::vector<LatticeMesh> parts;
  for (int k = 0; k < grid.size()[2] / grid.block(); ++k) {
    for (int j = 0; j < grid.size()[1] / grid.block(); ++j) {
      for (int i = 0; i < grid.size()[0] / grid.block(); ++i) {
        parts.push_back(initial_mesh(grid, octree, {i, j, k}, options));
      }
    }
  }
  return joined(parts);
}

inline std::int64_t orientation_of(const LatticeMesh& mesh, const std::array<VertexId, 4>& n) {
  return orientation(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
}

/// Six times the volume of every material, in cubed half cells; expects that all tets are positive.
inline std::map<MaterialId, std::int64_t> volumes_of(const LatticeMesh& mesh) {
  std::map<MaterialId, std::int64_t> volumes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::int64_t six = orientation_of(mesh, mesh.tets[t]);
    EXPECT_GT(six, 0);
    volumes[mesh.materials[t]] += six;
  }
  return volumes;
}

/// The same of the cells of a grid, background left out.
inline std::map<MaterialId, std::int64_t> volumes_of(const CellGrid& grid) {
  std::map<MaterialId, std::int64_t> volumes;
  for (int k = 0; k < grid.size()[2]; ++k) {
    for (int j = 0; j < grid.size()[1]; ++j) {
      for (int i = 0; i < grid.size()[0]; ++i) {
        if (grid.at(i, j, k) != kBackground) volumes[grid.at(i, j, k)] += 6 * 8;
      }
    }
  }
  return volumes;
}

inline TetNodes nodes_of(const LatticeMesh& mesh) {
  TetNodes nodes;
  for (const auto& n : mesh.tets) nodes.push_back(n);
  return nodes;
}

/// Euler characteristic of every material's surface.
inline std::map<MaterialId, long> surface_characteristics(const LatticeMesh& mesh) {
  std::map<MaterialId, long> of;
  const TetNodes nodes = nodes_of(mesh);
  for (const MaterialId m : mesh.materials) {
    if (!of.contains(m)) {
      of[m] =
          cbc3d::testing::euler_characteristic(cbc3d::testing::surface_of_label(nodes, mesh.materials, m));
    }
  }
  return of;
}

}  // namespace cbc3d::baselines::ld::testing
