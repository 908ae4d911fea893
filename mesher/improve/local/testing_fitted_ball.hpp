// A ball, a block of two labels, and meshes of them.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "mesher/domain/image_domain.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/lattice/testing_lattice_mesh.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::testing {

inline constexpr Vec3 kBallCentre = {19.3, 19.6, 19.4};

inline LabelImage ball() {
  return make_image({40, 40, 40}, {1, 1, 1}, 1,
                    [](const Vec3& p) { return (p - kBallCentre).norm() < 16.2 ? 1 : 0; });
}

/// Two labels in a block, on the two sides of an oblique plane.
inline LabelImage cut_block() {
  return make_image({30, 26, 24}, {1, 1, 1.2}, 2, [](const Vec3& p) {
    const bool inside = p.x > 3 && p.x < 26 && p.y > 3 && p.y < 22 && p.z > 3 && p.z < 24;
    return !inside ? 0 : p.x + 0.4 * p.y + 0.2 * p.z < 21 ? 1 : 2;
  });
}

/// A mesh of the ball, the lattice's or a finished one, whose vertices have moved to the image's
/// boundary.
struct FittedBall {
  LabelImage image = ball();
  MaterialMesh mesh;
  ImageDomain domain{image};
  std::vector<VertexId> covering;

  FittedBall(MaterialMesh of, double deviation_mm) : mesh(std::move(of)) {
    const auto sets = vertex_materials(mesh.tets, mesh.materials,
                                       tet_neighbours(mesh.tets, mesh.points.size()), mesh.points.size());
    covering = nearest_covering_vertices(domain.samples(), mesh.points, sets, 1.6);
    for (int sweep = 0; sweep < 8; ++sweep) {
      relax({.surface_weight = 1000, .max_step = 0.5, .skip_below_mm = 0}, deviation_mm);
    }
  }

  std::size_t relax(const RelaxOptions& options, double deviation_mm) {
    const double diagonal = image.frame.voxel_diagonal_mm();
    std::size_t moved = 0;
    improve_in_patches(mesh, covering,
                       {.boundaries = {domain},
                        .guards = {.deviation_mm = deviation_mm, .scale_mm = diagonal},
                        .samples = domain.samples(),
                        .reach_mm = 1.6,
                        .patch_tets = 10000000},
                       0, [&](Patch& patch) { moved += relax_vertices(patch, options); });
    return moved;
  }

  [[nodiscard]] std::vector<FaceKey> surface() const {
    return surface_of_label(mesh.tets, mesh.materials, MaterialId{1});
  }
  /// Deviation of every surface vertex from the image's boundary.
  [[nodiscard]] std::map<VertexId, double> deviations() const {
    std::map<VertexId, double> result;
    for (const FaceKey& f : surface()) {
      for (const VertexId v : f) {
        result[v] = domain.boundary_distance(mesh.points[v], 1, kBackground).deviation_mm;
      }
    }
    return result;
  }
};

/// Calls visit(a, b, inner) for every edge; inner: neither end is on an interface.
template <typename Visit>
void for_each_edge(const MaterialMesh& mesh, const Visit& visit) {
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  for (const auto& n : mesh.tets) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) {
        visit(n[i], n[j], sets[n[i]].size < 2 && sets[n[j]].size < 2);
      }
    }
  }
}

}  // namespace cbc3d::testing
