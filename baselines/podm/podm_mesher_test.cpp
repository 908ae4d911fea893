#include "baselines/podm/podm_mesher.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "mesher/core/error.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::podm {
namespace {

using cbc3d::testing::make_image;

PodmResult run(const LabelImage& image, double delta_mm, bool smooth = false, int threads = 1) {
  StageClock stages;
  return mesh_with_podm(image, {.refinement = {.delta_mm = delta_mm, .threads = threads}, .smooth = smooth},
                        stages);
}

double circumradius(const std::array<Vec3, 4>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3 sum =
      a.squared_norm() * b.cross(c) + b.squared_norm() * c.cross(a) + c.squared_norm() * a.cross(b);
  return sum.norm() / (2 * std::abs(a.dot(b.cross(c))));
}

double largest_radius_edge_ratio(const Mesh& mesh) {
  double largest = 0;
  for (const auto& n : mesh.tets.nodes) {
    const std::array<Vec3, 4> p{mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]};
    double shortest = 1e300;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = i + 1; j < 4; ++j) shortest = std::min(shortest, (p[i] - p[j]).norm());
    }
    largest = std::max(largest, circumradius(p) / shortest);
  }
  return largest;
}

// The facets between two labels and those on the outside.
std::vector<cbc3d::testing::FaceKey> boundary_facets(const Mesh& mesh) {
  std::map<cbc3d::testing::FaceKey, std::vector<Label>> sides;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n)
      sides[cbc3d::testing::face_key(mesh.tets.nodes[t], n)].push_back(mesh.tets.labels[t]);
  }
  std::vector<cbc3d::testing::FaceKey> facets;
  for (const auto& [facet, labels] : sides) {
    if (labels.size() == 1 || labels[0] != labels[1]) facets.push_back(facet);
  }
  return facets;
}

double smallest_facet_angle_deg(const Mesh& mesh) {
  double smallest = 180;
  for (const auto& f : boundary_facets(mesh)) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 a = mesh.points[f[(i + 1) % 3]] - mesh.points[f[i]];
      const Vec3 b = mesh.points[f[(i + 2) % 3]] - mesh.points[f[i]];
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
    }
  }
  return smallest;
}

// What holds of every mesh at the default options.
void expect_good(const Mesh& mesh) {
  EXPECT_EQ(cbc3d::testing::inverted_tets(mesh.tets.nodes, mesh.points), 0U);
  EXPECT_EQ(cbc3d::testing::crowded_faces(mesh.tets.nodes), 0U);
  EXPECT_LE(largest_radius_edge_ratio(mesh), 2 + 1e-6);
  EXPECT_GE(smallest_facet_angle_deg(mesh), 30 - 1e-6);
}

void expect_closed(const Mesh& mesh, Label label, long euler_characteristic) {
  const auto surface = cbc3d::testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, label);
  const auto faults = cbc3d::testing::faults_of_surface(surface);
  EXPECT_EQ(faults.edges, 0U) << "label " << label;
  EXPECT_EQ(faults.vertices, 0U) << "label " << label;
  EXPECT_EQ(cbc3d::testing::euler_characteristic(surface), euler_characteristic) << "label " << label;
}

LabelImage torus() {
  return make_image({48, 48, 24}, {1, 1, 1}, 1, [](const Vec3& p) {
    return std::hypot(std::hypot(p.x - 23.5, p.y - 23.4) - 15, p.z - 11.6) < 6 ? 1 : 0;
  });
}

// Three sectors of a cylinder with round ends.
LabelImage three_sectors() {
  return make_image({40, 40, 40}, {1, 1, 1}, 3, [](const Vec3& p) {
    const Vec3 q = p - Vec3{19.6, 19.4, 19.5};
    if (q.norm() > 15) return 0;
    const double turn = std::atan2(q.y, q.x + 0.3) / (2 * std::numbers::pi) + 0.5;
    return 1 + std::min(2, static_cast<int>(3 * turn));
  });
}

TEST(PodmMesher, ASphereIsClosedGoodAndNear) {
  constexpr double kRadius = 15;
  const LabelImage image = cbc3d::testing::ball_image(40, 1, kRadius);
  const Vec3 centre = cbc3d::testing::centre_of(image);
  for (const bool smooth : {false, true}) {
    for (const double delta : {1.5, 3.0}) {
      SCOPED_TRACE(delta);
      const Mesh mesh = run(image, delta, smooth).mesh;
      expect_good(mesh);
      // The voxels' own boundary is not smooth, so that samples as dense as its steps promise no manifold.
      if (smooth || delta > 2) expect_closed(mesh, 1, 2);
      const double voxel = smooth ? 0.5 : std::sqrt(3.0) / 2;
      const auto facets = boundary_facets(mesh);
      // A facet's ball has a radius of at most 2 delta, and the sphere is as far from its chord.
      const double sagitta = kRadius - std::sqrt(kRadius * kRadius - 4 * delta * delta);
      for (const auto& f : facets) {
        const Vec3 middle = (mesh.points[f[0]] + mesh.points[f[1]] + mesh.points[f[2]]) / 3;
        EXPECT_NEAR((mesh.points[f[0]] - centre).norm(), kRadius, voxel);
        EXPECT_NEAR((middle - centre).norm(), kRadius, voxel + sagitta);
      }
      for (int n = 0; n < 500; ++n) {
        const double z = 1 - (2 * n + 1) / 500.0, turn = 2.399963 * n, r = std::sqrt(1 - z * z);
        const Vec3 place = centre + kRadius * Vec3{r * std::cos(turn), r * std::sin(turn), z};
        double nearest = 1e300;
        for (const auto& f : facets) nearest = std::min(nearest, (mesh.points[f[0]] - place).norm());
        EXPECT_LE(nearest, 2 * delta + voxel);
      }
    }
  }
}

TEST(PodmMesher, ATorusHasItsHole) {
  for (const bool smooth : {false, true}) {
    const Mesh mesh = run(torus(), 2, smooth).mesh;
    expect_good(mesh);
    expect_closed(mesh, 1, 0);
  }
}

TEST(PodmMesher, ShellsLieWithinEachOther) {
  const LabelImage image = cbc3d::testing::ball_image(44, 1, 17, 9);
  const Mesh mesh = run(image, 2).mesh;
  expect_good(mesh);
  expect_closed(mesh, 2, 2);
  expect_closed(mesh, 1, 4);  // two spheres
  const double core = 4.0 / 3 * std::numbers::pi * 9 * 9 * 9;
  EXPECT_NEAR(cbc3d::testing::volume_of(mesh, 2) / core, 1, 0.06);
}

TEST(PodmMesher, ThreeLabelsMeetAlongALine) {
  const LabelImage image = three_sectors();
  const Mesh mesh = run(image, 1.5).mesh;
  expect_good(mesh);
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  for (Label label = 1; label <= 3; ++label) {
    const double truth = static_cast<double>(voxels[static_cast<std::size_t>(label)]);
    EXPECT_NEAR(cbc3d::testing::volume_of(mesh, label) / truth, 1, 0.05) << "label " << label;
  }
}

TEST(PodmMesher, SliversAreSplit) {
  const LabelImage image = cbc3d::testing::ball_image(40, 1, 15, 8);
  EXPECT_GT(cbc3d::testing::smallest_dihedral_deg(run(image, 1.5).mesh), 4);
}

TEST(PodmMesher, GoesOnWithoutTheRemovalOfFreeVerticesAndUpToItsCap) {
  const LabelImage image = three_sectors();
  StageClock stages;
  const PodmResult all = mesh_with_podm(image, {.refinement = {.delta_mm = 2}}, stages);
  EXPECT_GT(all.counts.removals, 0U);
  EXPECT_FALSE(all.counts.removals_capped);
  const PodmResult none =
      mesh_with_podm(image, {.refinement = {.delta_mm = 2, .remove_free = false}}, stages);
  EXPECT_EQ(none.counts.removals, 0U);
  expect_good(none.mesh);
  const double few =
      0.5 * static_cast<double>(all.counts.removals) / static_cast<double>(all.counts.surface_vertices);
  const PodmResult capped =
      mesh_with_podm(image, {.refinement = {.delta_mm = 2, .removals_per_surface_vertex = few}}, stages);
  EXPECT_TRUE(capped.counts.removals_capped);
  EXPECT_FALSE(capped.notes.empty());
  EXPECT_LE(static_cast<double>(capped.counts.removals),
            few * static_cast<double>(capped.counts.surface_vertices) + 1);
  expect_good(capped.mesh);
}

TEST(PodmMesher, TheSizeBoundsCircumradii) {
  const LabelImage image = cbc3d::testing::ball_image(40, 1, 15);
  StageClock stages;
  const PodmResult result = mesh_with_podm(image, {.refinement = {.delta_mm = 3, .size_mm = 3.2}}, stages);
  expect_good(result.mesh);
  for (const auto& n : result.mesh.tets.nodes) {
    const auto& p = result.mesh.points;
    EXPECT_LE(circumradius({p[n[0]], p[n[1]], p[n[2]], p[n[3]]}), 3.2 + 1e-6);
  }
}

TEST(PodmMesher, ALabelOfOneVoxelIsSampledAndSaid) {
  LabelImage image = cbc3d::testing::ball_image(30, 1, 10);
  image.frame.spacing_mm = {1, 0.8, 1.5};
  image.labels.push_back(77);
  image.voxels[image.frame.offset(15, 15, 15)] = 2;
  const PodmResult result = run(image, 4);
  EXPECT_EQ(labels_of(result.mesh), (std::vector<Label>{1, 77}));
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_NE(result.notes.front().find("77"), std::string::npos);
  EXPECT_GT(cbc3d::testing::volume_of(result.mesh, 77), 0.1);
  EXPECT_LT(cbc3d::testing::volume_of(result.mesh, 77), 2);
}

TEST(PodmMesher, EndsOnAnImageOfOneVoxelAtAnyDelta) {
  const LabelImage image = make_image({1, 1, 1}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
  for (const double delta : {0.3, 0.9, 1.0, 1.2, 3.0, 40.0}) {
    SCOPED_TRACE(delta);
    const Mesh mesh = run(image, delta).mesh;
    EXPECT_EQ(labels_of(mesh), std::vector<Label>{1});
    EXPECT_LT(mesh.tets.size(), 3000U);
  }
}

TEST(PodmMesher, EveryVoxelMayHaveALabelOfItsOwn) {
  LabelImage image = make_image({6, 6, 6}, {1, 1, 1}, 216, [](const Vec3&) { return 0; });
  for (std::size_t v = 0; v < image.voxels.size(); ++v) image.voxels[v] = static_cast<MaterialId>(v + 1);
  EXPECT_EQ(labels_of(run(image, 1.2).mesh).size(), 216U);
}

TEST(PodmMesher, RepeatsItselfWithOneThread) {
  const LabelImage image = cbc3d::testing::noisy_blocks_image(4, 3);
  const Mesh first = run(image, 1.2).mesh, second = run(image, 1.2).mesh;
  EXPECT_EQ(first.points, second.points);
  EXPECT_EQ(first.tets.nodes, second.tets.nodes);
  EXPECT_EQ(first.tets.labels, second.tets.labels);
}

TEST(PodmMesher, NoiseGivesAGoodMesh) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const LabelImage image = cbc3d::testing::noise_image(14, 0.6, seed);
    const PodmResult result = run(image, 1.2);
    expect_good(result.mesh);
    EXPECT_EQ(labels_of(result.mesh), (std::vector<Label>{1, 2}));
  }
}

TEST(PodmMesher, AnyNumberOfThreadsKeepsTheGuarantees) {
  const LabelImage image = cbc3d::testing::ball_image(64, 1, 27, 15);
  const double alone = static_cast<double>(run(image, 2).mesh.tets.size());
  for (const int threads : {2, 4, 8}) {
    SCOPED_TRACE(threads);
    const Mesh mesh = run(image, 2, false, threads).mesh;
    expect_good(mesh);
    expect_closed(mesh, 2, 2);
    expect_closed(mesh, 1, 4);
    EXPECT_NEAR(static_cast<double>(mesh.tets.size()) / alone, 1, 0.1);
  }
}

TEST(PodmMesher, RefusesAnImageWithoutLabels) {
  EXPECT_THROW(run(cbc3d::testing::noise_image(6, 0, 1), 1), InputError);
}

}  // namespace
}  // namespace cbc3d::baselines::podm
