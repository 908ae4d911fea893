// The presets: their options, and "quality" end to end: sound meshes of good angles with the image's
// topology.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::cavity_and_torus;
using testing::touching_balls;

Mesh mesh_of(const LabelImage& image, bool improve, MeshImageReport& report) {
  MeshImageOptions options = preset_options("quality", image.frame);
  options.improve.enabled = improve;
  Progress quiet;
  return mesh_image(image, options, quiet, report);
}
Mesh mesh_of(const LabelImage& image, bool improve = true) {
  MeshImageReport report;
  return mesh_of(image, improve, report);
}

void expect_sound(const Mesh& mesh, const std::vector<Label>& labels) {
  EXPECT_EQ(testing::inverted_tets(mesh.tets.nodes, mesh.points), 0U);
  EXPECT_EQ(testing::crowded_faces(mesh.tets.nodes), 0U);
  EXPECT_EQ(labels_of(mesh), labels);
  std::vector<std::uint8_t> used(mesh.points.size(), 0);
  for (const auto& nodes : mesh.tets.nodes) {
    for (const VertexId v : nodes) used[v] = 1;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);  // no vertex is left over
  for (const Label label : labels) {
    const auto faults =
        testing::faults_of_surface(testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, label));
    EXPECT_EQ(faults.edges, 0U) << "label " << label;
    EXPECT_EQ(faults.vertices, 0U) << "label " << label;
  }
}

/// Blocks of two or three voxels with a seeded material each, up to the image's border.
LabelImage blocks_image(const Index3& size, const Vec3& spacing_mm, int materials, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<int> drawn(1000);
  for (int& m : drawn)
    m = static_cast<int>(random() % static_cast<unsigned>(materials + 2)) % (materials + 1);
  return testing::make_image(size, spacing_mm, materials, [&](const Vec3& p) {
    const auto block = [&](int axis) {
      return static_cast<int>(std::lround(p[axis] / spacing_mm[axis])) * 2 / 5;
    };
    return drawn[static_cast<std::size_t>((block(0) * 10 + block(1)) * 10 + block(2)) % drawn.size()];
  });
}

TEST(QualityPreset, NoiseOfManyLabelsBecomesASoundMesh) {
  struct Case {
    LabelImage image;
    std::vector<Label> labels;
  };
  const std::vector<Case> cases = {{testing::noise_image(11, 0.4, 1), {1, 2}},
                                   {blocks_image({12, 11, 10}, {1, 1, 1}, 3, 2), {1, 2, 3}},
                                   {blocks_image({12, 10, 7}, {0.8, 1, 1.7}, 4, 3), {1, 2, 3, 4}},
                                   {blocks_image({10, 10, 10}, {1, 0.6, 1.1}, 1, 4), {1}}};
  for (std::size_t c = 0; c < cases.size(); ++c) {
    SCOPED_TRACE("case " + std::to_string(c));
    omp_set_num_threads(1);
    const Mesh one = mesh_of(cases[c].image);
    omp_set_num_threads(2);
    const Mesh two = mesh_of(cases[c].image);
    EXPECT_TRUE(one.points == two.points && one.tets.nodes == two.tets.nodes &&
                one.tets.labels == two.tets.labels);
    expect_sound(two, cases[c].labels);
  }
}

TEST(QualityPreset, AnObliqueFlippedFrameKeepsOrientation) {
  LabelImage image = touching_balls();
  image.frame = testing::oblique(image.frame, true);
  const Mesh mesh = mesh_of(image);
  expect_sound(mesh, {1, 2});
  EXPECT_GE(testing::smallest_dihedral_deg(mesh), 20);
}

TEST(QualityPreset, SmoothPhantomsHaveGoodAnglesAndTheirTopology) {
  struct Case {
    LabelImage image;
    std::vector<long> characteristics;
  };
  const std::vector<Case> cases = {
      {testing::ball_image(26, 1, 10), {2}},
      {touching_balls(), {2, 2}},
      {cavity_and_torus(), {4, 0}},
      {testing::ball_image(26, 1, 10, 5), {4, 2}},
  };
  for (std::size_t c = 0; c < cases.size(); ++c) {
    SCOPED_TRACE("case " + std::to_string(c));
    const LabelImage& image = cases[c].image;
    MeshImageReport report;
    const Mesh mesh = mesh_of(image, true, report);
    expect_sound(mesh, std::vector<Label>(image.labels.begin() + 1, image.labels.end()));
    EXPECT_GE(testing::smallest_dihedral_deg(mesh), 20);
    EXPECT_GE(report.improve.min_dihedral_after_deg, 20);
    EXPECT_EQ(report.improve.tets_after, mesh.tets.size());
    EXPECT_LT(report.improve.tets_after, report.improve.tets_before);
    const auto voxels = image.voxels_per_material();
    for (MaterialId m = 1, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
      EXPECT_EQ(testing::euler_characteristic(
                    testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, image.labels[m])),
                cases[c].characteristics[m - 1U]);
      const auto volume = static_cast<double>(voxels[m]);
      EXPECT_NEAR(testing::volume_of(mesh, image.labels[m]), volume, 0.015 * volume) << "label " << m;
    }
  }
}

TEST(QualityPreset, ABallIsRound) {
  const LabelImage image = testing::ball_image(26, 1, 10);
  const Mesh mesh = mesh_of(image);
  const double truth = 4.0 / 3 * std::numbers::pi * 1000;
  const auto voxels = static_cast<double>(image.voxels_per_material()[1]);
  EXPECT_NEAR(testing::volume_of(mesh, 1), voxels, 0.01 * voxels);
  EXPECT_NEAR(testing::volume_of(mesh, 1), truth, 0.01 * truth);
  double area = 0;
  double sum = 0;
  double farthest = 0;
  for (const testing::FaceKey& f : testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, Label{1})) {
    const Vec3& p = mesh.points[f[0]];
    const Vec3& q = mesh.points[f[1]];
    const Vec3& r = mesh.points[f[2]];
    const double weight = (q - p).cross(r - p).norm();
    for (const Vec3& x : {p, q, r, 0.5 * (p + q), 0.5 * (q + r), 0.5 * (r + p), (p + q + r) / 3}) {
      const double off = std::abs((x - testing::centre_of(image)).norm() - 10);
      sum += weight * off;
      area += weight;
      farthest = std::max(farthest, off);
    }
  }
  EXPECT_LT(sum / area, 0.2);
  EXPECT_LT(farthest, 0.9);
}

TEST(QualityPreset, EveryInterfaceOfTheImageHasVerticesNearby) {
  // Two slabs of different labels one voxel apart, and a third that touches both.
  const LabelImage image = testing::make_image({16, 14, 14}, {1, 1, 1}, 3, [](const Vec3& p) {
    const bool inside = p.x > 1 && p.x < 14 && p.y > 1 && p.y < 12 && p.z > 1 && p.z < 12;
    return !inside ? 0 : p.z > 8 ? 3 : p.x < 7 ? 1 : p.x > 8 ? 2 : 0;
  });
  const Mesh mesh = mesh_of(image);
  expect_sound(mesh, {1, 2, 3});
  const MaterialMesh local = to_material_mesh(mesh, image);
  const auto sets = vertex_materials(local.tets, local.materials,
                                     tet_neighbours(local.tets, local.points.size()), local.points.size());
  const double diagonal = image.frame.voxel_diagonal_mm();
  EXPECT_TRUE(uncovered_samples(boundary_samples(image), local.points, sets, 1.1 * diagonal).empty());
}

TEST(Presets, AreNamedAndOthersRefused) {
  const ImageFrame frame;
  for (const std::string& name : preset_names()) {
    EXPECT_NO_THROW(preset_options(name, frame)) << name;
    EXPECT_NO_THROW(deformation_preset_options(name)) << name;
  }
  try {
    preset_options("fast", frame);
    FAIL() << "an unknown preset is taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("fast"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("quality or paper"), std::string::npos);
  }
}

TEST(Presets, TheDeformationOfAGivenMeshReplacesTheImprovement) {
  for (const std::string& name : preset_names()) {
    const MeshImageOptions options = deformation_preset_options(name);
    EXPECT_FALSE(options.improve.enabled) << name;
    EXPECT_GT(options.deform.iterations, 0) << name;
  }
  EXPECT_EQ(deformation_preset_options("quality").deform.displacement.target_position,
            TargetPosition::voxel_faces);
  EXPECT_THROW(deformation_preset_options("fast"), InputError);
}

TEST(Presets, DistancesOfTheQualityPresetAreInVoxelDiagonals) {
  ImageFrame frame;
  const MeshImageOptions unit = preset_options("quality", frame);
  frame.spacing_mm = 3 * frame.spacing_mm;
  const MeshImageOptions large = preset_options("quality", frame);
  EXPECT_NEAR(large.refine.max_distance_mm, 3 * unit.refine.max_distance_mm, 1e-12);
  EXPECT_NEAR(large.improve.reach_mm, 3 * unit.improve.reach_mm, 1e-12);
  EXPECT_EQ(unit.improve.reach_mm, unit.refine.max_distance_mm);
  EXPECT_EQ(large.improve.deviation_diagonals, unit.improve.deviation_diagonals);
  EXPECT_TRUE(unit.improve.enabled);
  EXPECT_FALSE(preset_options("paper", frame).improve.enabled);
}

}  // namespace
}  // namespace cbc3d
