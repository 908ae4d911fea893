// The rounds of the refinement and what the candidate mesh holds after them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "mesher/domain/boundary_samples.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/refine_lattice.hpp"
#include "mesher/preprocess/clean_image.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::touching_balls;

TEST(RefineLattice, SmoothLabelsAreThoseOfTheBoundaryAtTheCentroids) {
  const LabelImage image = touching_balls();
  const ImageDomain domain(image);
  for (const bool smooth : {true, false}) {
    Lattice lattice = build_bcc_lattice(image, {3, 0.5});
    RefineOptions options;
    options.smooth_labels = smooth;
    options.one_face_rule = false;
    options.each_interface = true;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.finest_spacing_mm = 1;
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    const std::vector<Vec3> points = local_points(lattice);
    const CandidateMesh& mesh = result.mesh;
    std::size_t unlike_voxel = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Vec3 centroid;
      for (const VertexId v : mesh.tets.nodes[t]) centroid += 0.25 * points[v];
      unlike_voxel += mesh.materials[t] != image.at_local(centroid) ? 1 : 0;
      ASSERT_EQ(mesh.materials[t], smooth ? domain.material_at(centroid) : image.at_local(centroid));
    }
    EXPECT_EQ(unlike_voxel > 0, smooth);
    // The distance is held for every interface, as far as the lattice goes.
    const auto sets = vertex_materials(mesh.tets.nodes, mesh.materials, mesh.neighbours, points.size());
    EXPECT_EQ(uncovered_samples(boundary_samples(image), points, sets, options.max_distance_mm).size(),
              result.uncovered_voxels);
    EXPECT_EQ(result.uncovered_voxels, 0U);
  }
}

/// A closed box one voxel thick: with a lattice as coarse as the distance lets it be, it is full of holes.
TEST(RefineLattice, ThinPartsAreKeptVoxelByVoxel) {
  const LabelImage image = testing::make_image({20, 18, 16}, {1, 1, 1}, 1, [](const Vec3& p) {
    const bool inside = p.x > 2 && p.x < 16 && p.y > 2 && p.y < 14 && p.z > 2 && p.z < 12;
    const bool hollow = p.x > 3 && p.x < 15 && p.y > 3 && p.y < 13 && p.z > 3 && p.z < 11;
    return inside && !hollow ? 1 : 0;
  });
  const ImageDomain domain(image);
  for (const bool keep : {false, true}) {
    Lattice lattice = build_bcc_lattice(image, {10, 0.25});
    RefineOptions options;
    options.fidelity = 0.01;
    options.smooth_labels = options.each_interface = true;
    options.one_face_rule = false;
    options.keep_thin_parts = keep;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.finest_spacing_mm = 1;
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    EXPECT_EQ(result.fidelity[0].common_voxels == result.fidelity[0].image_voxels, keep);
  }
}

/// Vertices less edges plus faces less tets of a label, its boundary included.
std::ptrdiff_t euler_of_tets(const CandidateMesh& mesh, MaterialId label) {
  std::set<std::vector<VertexId>> simplices;
  std::ptrdiff_t tets = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.materials[t] != label) continue;
    ++tets;
    std::array<VertexId, 4> n = mesh.tets.nodes[t];
    std::sort(n.begin(), n.end());
    for (unsigned subset = 1; subset < 15; ++subset) {
      std::vector<VertexId> simplex;
      for (unsigned c = 0; c < 4; ++c)
        if ((subset >> c & 1U) != 0) simplex.push_back(n[c]);
      simplices.insert(simplex);
    }
  }
  std::ptrdiff_t chi = -tets;
  for (const auto& simplex : simplices) chi += simplex.size() % 2 == 1 ? 1 : -1;
  return chi;
}

/// The same of the label's voxels as closed cubes.
std::ptrdiff_t euler_of_voxels(const LabelImage& image, MaterialId label) {
  std::set<Index3> cells;  // of the doubled grid: odd coordinates are inside along their axis
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const auto [i, j, k] = image.frame.index_of(v);
    for (int part = 0; part < 27 && image.voxels[v] == label; ++part)
      cells.insert({2 * i + part % 3, 2 * j + part / 3 % 3, 2 * k + part / 9});
  }
  std::ptrdiff_t chi = 0;
  for (const auto& [x, y, z] : cells) chi += (x + y + z) % 2 == 0 ? 1 : -1;
  return chi;
}

/// Two labels that touch, with walls and tunnels of two voxels: a lattice that only keeps to distances loses
/// and adds some.
TEST(RefineLattice, EveryLabelKeepsTheTopologyOfTheImage) {
  LabelImage image = testing::make_image({26, 24, 18}, {1, 1, 1.4}, 2, [](const Vec3& p) {
    const double g = std::sin(1.3 * p.x) + std::sin(1.1 * p.y + 0.4 * p.x) + std::sin(0.9 * p.z + 0.2 * p.y);
    const bool inside = p.x > 1 && p.x < 24 && p.y > 1 && p.y < 22 && p.z > 1.5 && p.z < 22;
    return !inside ? 0 : g > 0.3 ? 1 : g < -1.1 ? 2 : 0;
  });
  clean_image(image, {.region_tolerance = 0, .well_composed = true}, true);
  const ImageDomain domain(image);
  std::ptrdiff_t off[2] = {0, 0};
  for (const bool keep : {false, true}) {
    RefineOptions options;
    options.fidelity = 0.01;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.smooth_labels = options.each_interface = true;
    options.finest_spacing_mm = 1;
    options.one_face_rule = false;
    options.topology_checks = true;
    options.topology_rounds = 0;
    options.repair_rounds = 16;
    options.repair_image_passes = 4;
    options.keep_topology = keep;
    Lattice lattice = build_bcc_lattice(image, {8, 0.25});
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    for (std::size_t m = 1; m < image.material_count(); ++m) {
      const auto material = static_cast<MaterialId>(m);
      off[keep ? 1 : 0] += std::abs(euler_of_tets(result.mesh, material) - euler_of_voxels(image, material));
    }
  }
  EXPECT_GT(off[0], 0);
  EXPECT_EQ(off[1], 0);
}

TEST(RefineLattice, NoTetOfALabelOrAtAnInterfaceIsCoarserThanAsked) {
  const LabelImage image = touching_balls();
  const ImageDomain domain(image);
  for (const bool at_interfaces : {false, true}) {
    Lattice lattice = build_bcc_lattice(image, {8, 0.5});
    RefineOptions options;
    options.fidelity = 0.01;
    (at_interfaces ? options.interface_spacing_mm : options.coarsest_spacing_mm) = 1;
    const RefineResult result = refine_lattice(lattice, domain, options, [](int, std::size_t) {});
    std::size_t coarse = 0;
    for (std::size_t t = 0; t < result.mesh.tets.size(); ++t) {
      if (lattice.frame.spacing_mm(lattice.reds[result.mesh.tets.parent[t]].level) > 1) {
        ASSERT_FALSE(at_interfaces ? result.mesh.is_at_interface(t)
                                   : result.mesh.materials[t] != kBackground);
        ++coarse;
      }
    }
    EXPECT_GT(coarse, 0U);
  }
}

}  // namespace
}  // namespace cbc3d
