// The improver's dials: smoothness of the surfaces within a cap, growth of the elements away from them.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesher/core/runtime.hpp"
#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/graded_sizes.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using Dials = std::function<void(ImproveOptions&)>;

Mesh mesh_of(const LabelImage& image, MeshImageOptions options, const Dials& turn) {
  turn(options.improve);
  Progress quiet;
  MeshImageReport report;
  return mesh_image(image, options, quiet, report);
}

Mesh mesh_of(const LabelImage& image, const Dials& turn) {
  return mesh_of(image, preset_options("quality", image.frame), turn);
}

/// Nearer to the boundary, so that images of this size have facets enough to be moved and tets within.
Mesh fine_mesh_of(const LabelImage& image, const Dials& turn) {
  MeshImageOptions options = preset_options("quality", image.frame);
  options.refine.max_distance_mm = 0.9 * image.frame.voxel_diagonal_mm();
  options.improve.reach_mm = options.refine.max_distance_mm;
  options.improve.deviation_diagonals = 0.2;
  options.stricter.reset();
  return mesh_of(image, options, turn);
}

constexpr Vec3 kBallCentre = {19.3, 19.6, 19.4};

LabelImage ball() {
  return testing::make_image({40, 40, 40}, {1, 1, 1}, 1,
                             [](const Vec3& p) { return (p - kBallCentre).norm() < 16.2 ? 1 : 0; });
}

/// Two labels in a block that is cut along a plane at a slant.
LabelImage cut_block() {
  return testing::make_image({30, 26, 24}, {1, 1, 1.2}, 2, [](const Vec3& p) {
    const bool inside = p.x > 3 && p.x < 26 && p.y > 3 && p.y < 22 && p.z > 3 && p.z < 24;
    return !inside ? 0 : p.x + 0.4 * p.y + 0.2 * p.z < 21 ? 1 : 2;
  });
}

/// Mean angle between the ball's true normals and those of the facets of its surface, by area, degrees.
double normal_error_deg(const std::vector<testing::FaceKey>& surface, const std::vector<Vec3>& points) {
  double sum = 0;
  double areas = 0;
  for (const testing::FaceKey& f : surface) {
    const Vec3 normal = (points[f[1]] - points[f[0]]).cross(points[f[2]] - points[f[0]]);
    const Vec3 outwards = (points[f[0]] + points[f[1]] + points[f[2]]) / 3 - kBallCentre;
    const double cosine = std::abs(normal.normalized().dot(outwards.normalized()));
    sum += normal.norm() * std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
    areas += normal.norm();
  }
  return sum / areas;
}

double normal_error_deg(const Mesh& mesh) {
  return normal_error_deg(testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, Label{1}),
                          mesh.points);
}

// ---- smoothness

/// A mesh, the lattice's or a finished one, whose vertices have been drawn to the image's boundary.
struct FittedBall {
  LabelImage image = ball();
  MaterialMesh mesh;
  std::vector<InterfacePoint> points = interface_points(image);
  ImageBoundary boundary{image, {}};
  std::vector<VertexId> hosts;

  FittedBall(double deviation_mm, bool finished)
      : mesh(to_material_mesh(fine_mesh_of(image, [&](ImproveOptions& o) { o.enabled = finished; }), image)) {
    const auto sets = vertex_materials(mesh.tets, mesh.materials,
                                       tet_neighbours(mesh.tets, mesh.points.size()), mesh.points.size());
    hosts = nearest_hosts(points, mesh.points, sets, 1.6);
    for (int sweep = 0; sweep < 8; ++sweep) {
      relax({1000, 0.5, 0}, deviation_mm);
    }
  }

  std::size_t relax(const RelaxOptions& options, double deviation_mm) {
    const double diagonal = image.frame.voxel_diagonal_mm();
    std::size_t moved = 0;
    improve_in_patches(mesh, hosts, {boundary, {deviation_mm, diagonal}, points, 1.6, 10000000}, 0,
                       [&](Patch& patch) { moved += relax_vertices(patch, options); });
    return moved;
  }

  [[nodiscard]] std::vector<testing::FaceKey> surface() const {
    return testing::surface_of_label(mesh.tets, mesh.materials, MaterialId{1});
  }
  /// Deviation of every surface vertex from the image's boundary.
  [[nodiscard]] std::map<VertexId, double> deviations() const {
    std::map<VertexId, double> result;
    for (const testing::FaceKey& f : surface()) {
      for (const VertexId v : f) {
        result[v] = boundary.sample(mesh.points[v], 1, kBackground).deviation_mm;
      }
    }
    return result;
  }
};

TEST(Smoothness, FlattensWithinItsCap) {
  for (const double cap_mm : {0.05, 0.15, 0.25}) {
    FittedBall trial(cap_mm, true);
    const double before = normal_error_deg(trial.surface(), trial.mesh.points);
    const auto near_before = trial.deviations();
    for (int sweep = 0; sweep < 6; ++sweep) {
      EXPECT_GT(trial.relax({1000, 0.5, 0, 0.8, cap_mm}, cap_mm), 0U);
    }
    EXPECT_EQ(testing::inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
    const double after = normal_error_deg(trial.surface(), trial.mesh.points);
    EXPECT_LT(after, (cap_mm < 0.1 ? 0.99 : 0.95) * before) << cap_mm;
    std::size_t farther = 0;
    for (const auto& [v, deviation] : trial.deviations()) {
      EXPECT_LE(deviation, std::max(cap_mm, near_before.at(v)) * (1 + 1e-9)) << cap_mm;
      farther += deviation > near_before.at(v) + 0.01 ? 1 : 0;
    }
    EXPECT_GT(farther, 10U);  // it does take vertices off the image's boundary
  }
}

TEST(Smoothness, LeavesASphereAsItIs) {
  // On a sphere all neighbours agree on where a vertex is, however the facets are cut: nothing shrinks.
  FittedBall trial(0.25, true);
  for (const auto& [v, deviation] : trial.deviations()) {
    Vec3& p = trial.mesh.points[v];
    p = kBallCentre + 16.2 * (p - kBallCentre).normalized();
  }
  ASSERT_EQ(testing::inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
  for (int sweep = 0; sweep < 8; ++sweep) {
    trial.relax({1000, 0.5, 0, 1, 0.8}, 0.8);  // smoothness alone
  }
  double sum = 0;
  std::size_t far = 0;
  const auto deviations = trial.deviations();
  for (const auto& [v, deviation] : deviations) {
    const double off = (trial.mesh.points[v] - kBallCentre).norm() - 16.2;
    sum += off;
    far += std::abs(off) > 0.1 ? 1 : 0;
  }
  EXPECT_LT(std::abs(sum) / static_cast<double>(deviations.size()), 0.02);
  // Where tets would turn over, a vertex may go to the image's boundary instead.
  EXPECT_LT(far, deviations.size() / 20);
}

TEST(Smoothness, TheWholeStageMakesFlatterSurfacesOfAsGoodTets) {
  const LabelImage image = ball();
  const auto voxels = static_cast<double>(image.voxels_per_material()[1]);
  const ImageBoundary boundary(image, {});
  for (const bool fine : {false, true}) {
    const auto mesh_with = [&](double smoothness) {
      const Dials dials = [smoothness](ImproveOptions& o) { o.smoothness = smoothness; };
      return fine ? fine_mesh_of(image, dials) : mesh_of(image, dials);
    };
    const Mesh smooth = mesh_with(0.5);
    EXPECT_LT(normal_error_deg(smooth), 0.96 * normal_error_deg(mesh_with(0))) << fine;
    EXPECT_NEAR(testing::volume_of(smooth, 1), voxels, 0.01 * voxels) << fine;
    // The stage's own boundary is moved by what the volume lacks; repair of the default's larger tets may go
    // to .5 diagonals.
    const double farthest_mm = (fine ? 0.45 : 0.55) * std::sqrt(3.0);
    for (const testing::FaceKey& f :
         testing::surface_of_label(smooth.tets.nodes, smooth.tets.labels, Label{1})) {
      for (const VertexId v : f) {
        EXPECT_LT(boundary.sample(smooth.points[v], 1, kBackground).deviation_mm, farthest_mm);
      }
    }
  }
}

TEST(Smoothness, IsTheSameAtAnyThreadCount) {
  const LabelImage image = cut_block();
  const Dials dials = [](ImproveOptions& o) {
    o.smoothness = 0.4;
    o.smoothness_cap_mm = 0.2;
    o.gradation = 0.2;
  };
  set_thread_count(1);
  const Mesh one = mesh_of(image, dials);
  set_thread_count(2);
  const Mesh two = mesh_of(image, dials);
  set_thread_count(0);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.tets.nodes, two.tets.nodes);
  EXPECT_EQ(testing::inverted_tets(two.tets.nodes, two.points), 0U);
}

// ---- gradation

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

TEST(Gradation, SizesGrowFromTheInterfacesByTheWay) {
  const LabelImage image = cut_block();
  const MaterialMesh mesh =
      to_material_mesh(mesh_of(image, [](ImproveOptions& o) { o.enabled = false; }), image);
  constexpr double kGradation = 0.3;
  const std::vector<double> flat = graded_sizes(mesh, 0);
  const std::vector<double> sizes = graded_sizes(mesh, kGradation);
  std::vector<double> least(mesh.points.size(), 1e300);  // by way of a neighbour
  const double smallest = *std::min_element(flat.begin(), flat.end());
  for_each_edge(mesh, [&](VertexId a, VertexId b, bool) {
    const double way = kGradation * (mesh.points[a] - mesh.points[b]).norm();
    least[a] = std::min(least[a], sizes[b] + way);
    least[b] = std::min(least[b], sizes[a] + way);
    EXPECT_LE(std::abs(sizes[a] - sizes[b]), way * (1 + 1e-12));
    EXPECT_EQ(flat[a], smallest);  // nothing grows: the smallest is everywhere
  });
  EXPECT_EQ(flat[0], smallest);
  const auto sets = vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                                     mesh.points.size());
  double largest = 0;
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    largest = std::max(largest, sizes[v]);
    if (sets[v].size < 2) {
      EXPECT_DOUBLE_EQ(sizes[v], least[v]);  // an inner vertex has its size from a neighbour
    }
  }
  EXPECT_GT(largest, smallest + 1);
}

/// The largest ratio of an inner edge to what the gradation allows it.
double worst_growth(const LabelImage& image, const Mesh& made, double gradation) {
  const MaterialMesh mesh = to_material_mesh(made, image);
  const std::vector<double> sizes = graded_sizes(mesh, gradation);
  double worst = 0;
  for_each_edge(mesh, [&](VertexId a, VertexId b, bool inner) {
    if (inner) {
      worst = std::max(worst, (mesh.points[a] - mesh.points[b]).norm() / (0.5 * (sizes[a] + sizes[b])));
    }
  });
  return worst;
}

TEST(Gradation, CollapsesKeepToIt) {
  FittedBall trial(0.25, false);
  const auto key = [](VertexId a, VertexId b) { return std::array{std::min(a, b), std::max(a, b)}; };
  std::set<std::array<VertexId, 2>> old;
  for_each_edge(trial.mesh, [&](VertexId a, VertexId b, bool) { old.insert(key(a, b)); });
  const std::vector<double> sizes = graded_sizes(trial.mesh, 0.3);
  const auto longer_than_allowed = [&](bool graded) {
    MaterialMesh mesh = trial.mesh;
    std::vector<VertexId> hosts = trial.hosts;
    PatchRules rules{trial.boundary, {0.25, std::sqrt(3.0)}, trial.points, 1.6, 10000000};
    rules.longest_mm = sizes;
    std::size_t collapsed = 0;
    improve_in_patches(mesh, hosts, rules, 0, [&](Patch& patch) {
      collapsed += collapse_edges(patch, {0.03, 4, nullptr, false, graded});
    });
    EXPECT_GT(collapsed, 5U);
    std::size_t count = 0;
    for_each_edge(mesh, [&](VertexId a, VertexId b, bool inner) {
      const double length = (mesh.points[a] - mesh.points[b]).norm();
      count += inner && !old.contains(key(a, b)) && length > 0.5 * (sizes[a] + sizes[b]) ? 1 : 0;
    });
    return count;
  };
  EXPECT_GT(longer_than_allowed(false), 0U);
  EXPECT_EQ(longer_than_allowed(true), 0U);
}

TEST(Gradation, BoundsTheGrowthAndCostsTets) {
  const LabelImage image = ball();
  const Mesh free = fine_mesh_of(image, [](ImproveOptions&) {});
  const double growth = worst_growth(image, free, 0.2);
  std::size_t tets = free.tets.size();
  for (const double gradation : {0.8, 0.2}) {
    const Mesh mesh = fine_mesh_of(image, [&](ImproveOptions& o) { o.gradation = gradation; });
    EXPECT_GT(mesh.tets.size(), tets) << gradation;
    tets = mesh.tets.size();
    // The lattice itself doubles from cell to cell, and is not split.
    EXPECT_LT(worst_growth(image, mesh, 0.2), (gradation < 0.5 ? 0.6 : 0.9) * growth) << gradation;
  }
}

}  // namespace
}  // namespace cbc3d
