// The method end to end on images with known answers.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/preprocess/clean_image.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

Mesh mesh_of(const LabelImage& image, const MeshImageOptions& options, MeshImageReport& report) {
  Progress quiet;
  return mesh_image(image, options, quiet, report);
}

Mesh mesh_of(const LabelImage& image, const std::string& preset = "quality") {
  MeshImageReport report;
  return mesh_of(image, preset_options(preset, image.frame), report);
}

Vec3 centroid_of(const Mesh& mesh, Label label) {
  Vec3 sum;
  double volume = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.tets.labels[t] == label) {
      const auto& n = mesh.tets.nodes[t];
      const double six =
          six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
      sum += six * 0.25 * (mesh.points[n[0]] + mesh.points[n[1]] + mesh.points[n[2]] + mesh.points[n[3]]);
      volume += six;
    }
  }
  return sum / volume;
}

using testing::volume_of;

bool same_mesh(const Mesh& a, const Mesh& b) {
  return a.points == b.points && a.tets.nodes == b.tets.nodes && a.tets.labels == b.tets.labels;
}

TEST(MeshImage, BallHasTheVolumeOfTheBall) {
  const LabelImage image = testing::ball_image(48, 1, 18, 9);
  const Mesh mesh = mesh_of(image);
  const double core = 4.0 / 3 * std::numbers::pi * 9 * 9 * 9;
  const double shell = 4.0 / 3 * std::numbers::pi * 18 * 18 * 18 - core;
  EXPECT_NEAR(volume_of(mesh, 2), core, 0.04 * core);
  EXPECT_NEAR(volume_of(mesh, 1), shell, 0.02 * shell);
  EXPECT_GE(testing::smallest_dihedral_deg(mesh), 5);
}

TEST(MeshImage, BallSurfaceLiesNearTheSphere) {
  const LabelImage image = testing::ball_image(48, 1, 18);
  const Mesh mesh = mesh_of(image);
  const auto neighbours = tet_neighbours(mesh.tets.nodes, mesh.points.size());
  double farthest = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (neighbours[t][n] == kNoTet) {
        for (const std::uint8_t c : kTetFace[n]) {
          const double r = (mesh.points[mesh.tets.nodes[t][c]] - testing::centre_of(image)).norm();
          farthest = std::max(farthest, std::abs(r - 18));
        }
      }
    }
  }
  EXPECT_LT(farthest, 0.9);  // below a voxel; its voxels themselves are up to .87 away
}

TEST(MeshImage, AThinPlateKeepsItsThickness) {
  // Targets on both sides of a plate of two voxels lie within reach of every surface vertex; the far side
  // must not pull.
  const LabelImage image = testing::make_image({40, 40, 20}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.x > 4 && p.x < 35 && p.y > 4 && p.y < 35 && p.z > 8.5 && p.z < 10.5 ? 1 : 0;
  });
  const double truth = static_cast<double>(image.voxels_per_material()[1]);
  EXPECT_NEAR(volume_of(mesh_of(image), 1), truth, 0.1 * truth);
}

TEST(MeshImage, SameBytesAtOneAndTwoThreads) {
  for (const char* preset : {"quality", "paper"}) {
    const LabelImage image = testing::ball_image(40, 1.1, 15, 7);
    omp_set_num_threads(1);
    const Mesh one = mesh_of(image, preset);
    omp_set_num_threads(2);
    const Mesh two = mesh_of(image, preset);
    EXPECT_TRUE(same_mesh(one, two)) << preset;
  }
}

TEST(MeshImage, ObliqueAndFlippedImagesGiveTheSameMeshInTheirOwnFrame) {
  const LabelImage straight = testing::make_image({40, 36, 24}, {0.9, 1.1, 1.7}, 2, [](const Vec3& p) {
    return (p - Vec3{17, 19, 20}).norm() < 11 ? (p.x < 17 ? 1 : 2) : 0;
  });
  const Mesh reference = mesh_of(straight);
  for (const bool flipped : {false, true}) {
    LabelImage turned = straight;
    turned.frame = testing::oblique(straight.frame, flipped);
    const Mesh mesh = mesh_of(turned);
    ASSERT_EQ(mesh.points.size(), reference.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); v += 13) {
      EXPECT_LT((mesh.points[v] - turned.frame.to_physical(reference.points[v])).norm(), 1e-9);
    }
    for (const Label label : {1, 2}) {
      EXPECT_NEAR(volume_of(mesh, label), volume_of(reference, label), 1e-6);
    }
    EXPECT_GE(testing::smallest_dihedral_deg(mesh), 5);  // positive orientation in the flipped frame too
  }
}

TEST(MeshImage, CentroidsOfASymmetricPhantomAreThoseOfItsVoxels) {
  const LabelImage image = testing::ball_image(41, 1.2, 18, 9);
  const Mesh mesh = mesh_of(image);
  for (const Label label : {1, 2}) {
    EXPECT_LT((centroid_of(mesh, label) - testing::centre_of(image)).norm(), 0.12);
  }
}

TEST(MeshImage, MeetsFidelityOrSaysWhyNot) {
  const LabelImage image = testing::ball_image(48, 1, 18, 9);
  MeshImageOptions options;
  MeshImageReport report;
  mesh_of(image, options, report);
  ASSERT_EQ(report.refine.fidelity.size(), 2U);
  for (const MaterialFidelity& f : report.refine.fidelity) {
    EXPECT_TRUE(f.met()) << f.label << ' ' << f.f1() << ' ' << f.f2();
  }
  // Cores of 3 and 6 voxels radius fall short of .95 on a lattice that stops at the voxel, and that is said.
  for (const double core_mm : {3.0, 6.0}) {
    MeshImageReport small;
    mesh_of(testing::ball_image(48, 1, 18, core_mm), options, small);
    const auto unmet = std::count_if(small.refine.fidelity.begin(), small.refine.fidelity.end(),
                                     [](const MaterialFidelity& f) { return !f.met(); });
    EXPECT_GT(unmet, 0);
    EXPECT_EQ(static_cast<std::size_t>(unmet), small.refine.warnings.size());
    // A finer lattice meets it.
    MeshImageOptions finer = options;
    finer.refine.finest_spacing_mm = 0.25;
    MeshImageReport fine;
    mesh_of(testing::ball_image(48, 1, 18, core_mm), finer, fine);
    EXPECT_TRUE(fine.refine.warnings.empty());
  }
  options.refine.fidelity = 1;  // cannot be met by a lattice that stops at the voxel
  MeshImageReport strict;
  mesh_of(image, options, strict);
  EXPECT_EQ(strict.refine.warnings.size(), 2U);
}

TEST(MeshImage, AMaterialThatMeetsItsFidelityIsNotRefined) {
  const LabelImage image = testing::make_image({60, 30, 30}, {1, 1, 1}, 2, [](const Vec3& p) {
    return (p - Vec3{14, 15, 15}).norm() < 10 ? 1 : (p - Vec3{45, 15, 15}).norm() < 10 ? 2 : 0;
  });
  const auto tets_of = [&](Label label, double fidelity_of_2) {
    MeshImageOptions options;
    options.deform.iterations = 0;
    options.refine.fidelity = 0.6;
    options.refine.material_fidelity[2] = fidelity_of_2;
    MeshImageReport report;
    const Mesh mesh = mesh_of(image, options, report);
    return std::count(mesh.tets.labels.begin(), mesh.tets.labels.end(), label);
  };
  EXPECT_EQ(tets_of(1, 0.6),
            tets_of(1, 0.97));  // the balls are far enough apart for the closure not to spread
  EXPECT_GT(tets_of(2, 0.97), 4 * tets_of(2, 0.6));
}

/// The largest distance from a boundary voxel's centre to a vertex on the mesh's outer surface, by brute
/// force.
double farthest_boundary_voxel(const LabelImage& image, const Mesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets.nodes, mesh.points.size());
  std::vector<Vec3> surface;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (neighbours[t][n] == kNoTet) {
        for (const std::uint8_t c : kTetFace[n]) surface.push_back(mesh.points[mesh.tets.nodes[t][c]]);
      }
    }
  }
  double farthest = 0;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    if (image.voxels[v] != kBackground && is_boundary_voxel(image, at[0], at[1], at[2])) {
      double nearest = 1e9;
      for (const Vec3& p : surface)
        nearest = std::min(nearest, (p - image.frame.local_centre(at[0], at[1], at[2])).norm());
      farthest = std::max(farthest, nearest);
    }
  }
  return farthest;
}

TEST(MeshImage, MaxDistanceFindsTheHoleAndTheWireThatFidelityMisses) {
  const LabelImage image = testing::make_image({70, 40, 40}, {1, 1, 1}, 1, [](const Vec3& p) {
    const bool hole = (p - Vec3{20, 20, 20}).norm() < 0.5;  // one voxel
    const bool wire =
        p.x > 20 && p.x < 60 && std::abs(p.y - 20) < 0.6 && std::abs(p.z - 20) < 0.6;  // one voxel thick
    return ((p - Vec3{20, 20, 20}).norm() < 16 || wire) && !hole ? 1 : 0;
  });
  const auto farthest = [&](double max_distance_mm) {
    MeshImageOptions options;
    options.deform.iterations = 0;
    options.refine.max_distance_mm = max_distance_mm;
    MeshImageReport report;
    const Mesh mesh = mesh_of(image, options, report);
    EXPECT_TRUE(report.refine.fidelity[0].met());
    EXPECT_EQ(report.refine.uncovered_voxels, 0U);
    return farthest_boundary_voxel(image, mesh);
  };
  EXPECT_GT(farthest(0), 10);
  EXPECT_LE(farthest(1.75), 1.75);
}

TEST(MeshImage, EveryLabelOfANoisyImageIsInTheMeshOrNamed) {
  const LabelImage image = testing::noise_image(20, 0.3, 5);
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, preset_options("quality", image.frame), report);
  EXPECT_GE(testing::smallest_dihedral_deg(mesh), 5);
  for (const Label label : {1, 2}) {
    const auto labels = labels_of(mesh);
    const bool there = std::find(labels.begin(), labels.end(), label) != labels.end();
    const bool named = std::any_of(report.warnings.begin(), report.warnings.end(), [&](const std::string& w) {
      return w.find("label " + std::to_string(label) + " (") != std::string::npos;
    });
    EXPECT_TRUE(there || named);
  }
}

TEST(MeshImage, NoLabelledTetKeepsTwoFacesTowardsBackground) {
  const LabelImage image = testing::noise_image(24, 0.5, 11);
  MeshImageOptions options;
  options.deform.iterations = 0;
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, options, report);
  const auto neighbours = tet_neighbours(mesh.tets.nodes, mesh.points.size());
  ASSERT_GT(mesh.tets.size(), 100U);
  for (const auto& n : neighbours) {
    EXPECT_LE(std::count(n.begin(), n.end(), kNoTet), 1);
  }
}

TEST(MeshImage, DoesNotDependOnLabelOrder) {
  const LabelImage image = testing::make_image({40, 30, 30}, {1, 1, 1}, 2, [](const Vec3& p) {
    return (p - Vec3{14, 15, 15}).norm() < 11 ? 1 : (p - Vec3{24, 15, 15}).norm() < 9 ? 2 : 0;
  });
  LabelImage swapped = image;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const MaterialId m = image.voxels[v];
    swapped.voxels.set(v, m == 0 ? m : static_cast<MaterialId>(3 - m));
  }
  const Mesh a = mesh_of(image, "paper");
  const Mesh b = mesh_of(swapped, "paper");
  ASSERT_EQ(a.tets.size(), b.tets.size());
  EXPECT_NEAR(volume_of(a, 1), volume_of(b, 2), 1e-9);
  EXPECT_NEAR(volume_of(a, 2), volume_of(b, 1), 1e-9);
}

TEST(MeshImage, WarnsOfTopologyChecksWithoutVoxelCleaning) {
  const LabelImage image = testing::ball_image(24, 1, 8);
  MeshImageOptions options;
  options.topology.enabled = true;
  options.clean.manifold_voxels = false;
  MeshImageReport report;
  Progress quiet;
  mesh_image(image, options, quiet, report);
  EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& w) {
    return w.find("manifold_voxels off") != std::string::npos;
  }));
}

TEST(MeshImage, ANumberOfElementsIsMetWithinATenth) {
  const LabelImage image = testing::ball_image(48, 1, 18, 9);
  MeshImageOptions options = preset_options("quality", image.frame);
  MeshImageReport report;
  const double by_default = static_cast<double>(mesh_of(image, options, report).tets.size());
  for (const double share : {0.5, 2.0, 8.0}) {
    options.elements = static_cast<std::size_t>(share * by_default);
    const Mesh mesh = mesh_of(image, options, report);
    EXPECT_NEAR(static_cast<double>(mesh.tets.size()), share * by_default, 0.1 * share * by_default);
    EXPECT_GE(testing::smallest_dihedral_deg(mesh), 20);
  }
}

TEST(MeshImage, ANumberOfElementsThatTheImageForbidsIsSaid) {
  const LabelImage image = testing::ball_image(24, 1, 9, 4);
  MeshImageOptions options = preset_options("quality", image.frame);
  options.elements = 5;
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, options, report);
  EXPECT_GT(mesh.tets.size(), 5U);
  EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [](const std::string& warning) {
    return warning.find("elements 5 could not be met") == 0;
  }));
}

TEST(MeshImage, AnEdgeLengthIsThatOfTheSurfaces) {
  const LabelImage image = testing::ball_image(48, 1, 18);
  for (const double length_mm : {1.5, 3.0, 5.0}) {
    MeshImageOptions options = preset_options("quality", image.frame);
    options.edge_length_mm = length_mm;
    MeshImageReport report;
    const Mesh mesh = mesh_of(image, options, report);
    const auto neighbours = tet_neighbours(mesh.tets.nodes, mesh.points.size());
    double sum = 0;
    std::size_t edges = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      for (std::size_t n = 0; n < 4; ++n) {
        for (std::size_t c = 0; neighbours[t][n] == kNoTet && c < 3; ++c, ++edges) {
          sum += (mesh.points[mesh.tets.nodes[t][kTetFace[n][c]]] -
                  mesh.points[mesh.tets.nodes[t][kTetFace[n][(c + 1) % 3]]])
                     .norm();
        }
      }
    }
    EXPECT_NEAR(sum / static_cast<double>(edges), length_mm, 0.3 * length_mm);
  }
}

/// Of a noisy image, in which hardly anything is thicker than three voxels.
TEST(MeshImage, TheReportNamesEveryLabelWhoseTopologyIsNotTheImages) {
  const LabelImage image = testing::make_image({22, 20, 16}, {1, 1, 1.5}, 2, [](const Vec3& p) {
    const double g = std::sin(1.3 * p.x) + std::sin(1.1 * p.y + 0.4 * p.x) + std::sin(0.9 * p.z + 0.2 * p.y);
    return g > 1 ? 1 : g < -1.3 ? 2 : 0;
  });
  MeshImageOptions options = preset_options("quality", image.frame);
  LabelImage clean = image;
  clean_image(clean, options.clean, true);
  std::map<Label, Betti> expected = betti_of_labels(clean);
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, options, report);
  for (const LabelDifference& d : report.topology_differences) {
    EXPECT_EQ(d.in_image, expected.at(d.label));
    expected[d.label] = d.in_mesh;
    EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [&](const std::string& warning) {
      return warning.starts_with("label " + std::to_string(d.label) + " has ");
    }));
  }
  for (const auto& [label, betti] : expected) {
    EXPECT_EQ(
        testing::euler_characteristic(testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, label)),
        2 * (betti.parts - betti.tunnels + betti.cavities));
  }
}

/// A surface with edges as short as a voxel is as smooth as one with long ones, and nearer to the ball.
TEST(MeshImage, ShortEdgesDoNotFollowTheStepsOfTheVoxels) {
  const LabelImage image = testing::ball_image(48, 1, 18);
  MeshImageOptions options = preset_options("quality", image.frame);
  options.edge_length_mm = 1;
  MeshImageReport report;
  const Mesh mesh = mesh_of(image, options, report);
  const auto neighbours = tet_neighbours(mesh.tets.nodes, mesh.points.size());
  const Vec3 centre = {23.5, 23.5, 23.5};
  double sum_deg = 0;
  double largest_mm = 0;
  std::size_t facets = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      if (neighbours[t][n] != kNoTet) continue;
      std::array<Vec3, 3> p{};
      for (std::size_t c = 0; c < 3; ++c) p[c] = mesh.points[mesh.tets.nodes[t][kTetFace[n][c]]] - centre;
      const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      const double cosine = std::fabs(normal.dot((p[0] + p[1] + p[2]).normalized()));
      sum_deg += std::acos(std::min(1.0, cosine)) * 180 / std::numbers::pi;
      for (const Vec3& corner : p) largest_mm = std::max(largest_mm, std::fabs(corner.norm() - 18));
      ++facets;
    }
  }
  EXPECT_LE(sum_deg / static_cast<double>(facets), 6);
  EXPECT_LE(largest_mm, 0.4);
}

/// The mean ratio that a twentieth of a label's tets is below, and their number.
std::pair<double, std::size_t> shape_of_label(const Mesh& mesh, Label label) {
  std::vector<double> ratios;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.tets.labels[t] != label) continue;
    const auto& n = mesh.tets.nodes[t];
    const auto p = [&](std::size_t c) { return mesh.points[n[c]]; };
    ratios.push_back(1 / std::cbrt(shape_energy(p(0), p(1), p(2), p(3))));
  }
  std::sort(ratios.begin(), ratios.end());
  return {ratios[ratios.size() / 20], ratios.size()};
}

TEST(MeshImage, ThinPartsHaveEdgesThatFitTheirThickness) {
  // A plate of one voxel, and a thick block beside it.
  const LabelImage image = testing::make_image({40, 24, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool within = p.y >= 3 && p.y < 21;
    const bool in_plate = within && p.x >= 3 && p.x < 21 && p.z >= 9 && p.z < 10;
    const bool in_block = within && p.x >= 25 && p.x < 37 && p.z >= 4 && p.z < 16;
    return in_plate ? 1 : in_block ? 2 : 0;
  });
  MeshImageOptions options = preset_options("quality", image.frame);
  MeshImageReport report;
  const Mesh fitting = mesh_of(image, options, report);
  options.improve.edges_per_thickness = 0;
  const Mesh flat = mesh_of(image, options, report);
  const auto [ratio, tets] = shape_of_label(fitting, 1);
  const auto [flat_ratio, flat_tets] = shape_of_label(flat, 1);
  EXPECT_GT(ratio, 1.15 * flat_ratio);
  EXPECT_LT(tets, 3 * flat_tets);
  EXPECT_NEAR(static_cast<double>(shape_of_label(fitting, 2).second),
              static_cast<double>(shape_of_label(flat, 2).second), 0.05 * static_cast<double>(flat_tets));
}

TEST(MeshImage, ADialWithoutEffectIsRefused) {
  const LabelImage image = testing::ball_image(16, 1, 5);
  for (const bool of_elements : {true, false}) {
    MeshImageOptions options = preset_options("paper", image.frame);
    (of_elements ? options.elements = 1000 : options.elements = 0);
    options.edge_length_mm = of_elements ? 0 : 2;
    MeshImageReport report;
    EXPECT_THROW(mesh_of(image, options, report), InputError);
  }
}

TEST(MeshImage, AThinBoxAndAWireKeepTheirTopology) {
  const LabelImage image = testing::make_image({22, 20, 18}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = p.x > 2 && p.x < 16 && p.y > 2 && p.y < 14 && p.z > 2 && p.z < 12;
    const bool hollow = p.x > 3 && p.x < 15 && p.y > 3 && p.y < 13 && p.z > 3 && p.z < 11;
    const bool wire = p.y == 16 && p.z == 14 && p.x > 2 && p.x < 19;
    return inside && !hollow ? 1 : wire ? 2 : 0;
  });
  const Mesh mesh = mesh_of(image);
  const auto surface = [&](Label label) {
    return testing::euler_characteristic(testing::surface_of_label(mesh.tets.nodes, mesh.tets.labels, label));
  };
  EXPECT_EQ(surface(1), 4);  // two spheres: a shell
  EXPECT_EQ(surface(2), 2);  // one
}

}  // namespace
}  // namespace cbc3d
