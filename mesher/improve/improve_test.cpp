// The improver: each operation on a mesh of its own, the whole stage, and the preset that uses it.
#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/improve/local/edge_collapse.hpp"
#include "mesher/improve/local/edge_removal.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/mesh_checks.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

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

LabelImage touching_balls() {
  return testing::make_image({26, 18, 18}, {1, 1, 1}, 2, [](const Vec3& p) {
    return (p - Vec3{8.2, 8.6, 8.5}).norm() < 6.1 ? 1 : (p - Vec3{17, 8.4, 8.7}).norm() < 6.3 ? 2 : 0;
  });
}

/// Label 1: a ball with a cavity (two spheres); label 2: a torus that goes round nothing.
LabelImage cavity_and_torus() {
  return testing::make_image({42, 26, 18}, {1, 1, 1}, 2, [](const Vec3& p) {
    const double r = (p - Vec3{9, 12, 8.5}).norm();
    const Vec3 q = p - Vec3{29, 12.5, 8.5};
    const double ring = std::hypot(q.x, q.y) - 7;
    return r < 7 && r > 3 ? 1 : std::hypot(ring, q.z) < 2.8 ? 2 : 0;
  });
}

/// The lattice mesh of an image as one patch, with all that the operations ask for.
struct Trial {
  LabelImage image;
  MaterialMesh mesh;
  std::vector<InterfacePoint> points;
  std::vector<VertexId> hosts;
  ImageBoundary boundary;
  PatchRules rules;

  explicit Trial(const LabelImage& from)
      : image(from),
        mesh(to_material_mesh(mesh_of(from, false), from)),
        points(interface_points(image)),
        boundary(image, {}),
        rules{boundary, {0.15 * diagonal(), diagonal()}, points, 0.9 * diagonal(), 10000000} {
    hosts = nearest_hosts(points, mesh.points, sets(), rules.reach_mm);
  }

  [[nodiscard]] double diagonal() const { return image.frame.voxel_diagonal_mm(); }
  [[nodiscard]] std::vector<MaterialSet> sets() const {
    return vertex_materials(mesh.tets, mesh.materials, tet_neighbours(mesh.tets, mesh.points.size()),
                            mesh.points.size());
  }
  void apply(const std::function<void(Patch&)>& operation, int round = 0) {
    improve_in_patches(mesh, hosts, rules, round, operation);
  }

  [[nodiscard]] double worst_sine_squared() const {
    double worst = 1;
    for (const auto& n : mesh.tets) {
      worst = std::min(worst, min_sine_squared(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]],
                                               mesh.points[n[3]]));
    }
    return worst;
  }
  [[nodiscard]] std::vector<double> volumes() const {
    std::vector<double> sums(image.material_count(), 0.0);
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto& n = mesh.tets[t];
      sums[mesh.materials[t]] +=
          six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
    }
    return sums;
  }
  [[nodiscard]] std::vector<long> characteristics() const {
    std::vector<long> chi;
    for (MaterialId m = 1, end = static_cast<MaterialId>(image.material_count()); m < end; ++m) {
      chi.push_back(testing::euler_characteristic(testing::surface_of_label(mesh.tets, mesh.materials, m)));
    }
    return chi;
  }
};

/// Positive, conforming, every label a manifold, hosts within reach and on their interface, none of them
/// lost.
void expect_sound(const Trial& trial, std::size_t hosted) {
  EXPECT_EQ(testing::inverted_tets(trial.mesh.tets, trial.mesh.points), 0U);
  EXPECT_EQ(testing::crowded_faces(trial.mesh.tets), 0U);
  for (MaterialId m = 1, end = static_cast<MaterialId>(trial.image.material_count()); m < end; ++m) {
    const auto faults =
        testing::faults_of_surface(testing::surface_of_label(trial.mesh.tets, trial.mesh.materials, m));
    EXPECT_EQ(faults.edges, 0U) << "label " << m;
    EXPECT_EQ(faults.vertices, 0U) << "label " << m;
  }
  const auto sets = trial.sets();
  std::size_t found = 0;
  std::size_t out_of_reach = 0;
  for (std::size_t p = 0; p < trial.points.size(); ++p) {
    const VertexId host = trial.hosts[p];
    if (host != kNoVertex) {
      ++found;
      const double distance = (trial.mesh.points[host] - trial.points[p].centre()).norm();
      out_of_reach +=
          distance > trial.rules.reach_mm * (1 + 1e-12) || !trial.points[p].is_on(sets[host]) ? 1 : 0;
    }
  }
  EXPECT_EQ(out_of_reach, 0U);
  EXPECT_EQ(found, hosted);
}

std::size_t hosted(const Trial& trial) {
  return trial.points.size() -
         static_cast<std::size_t>(std::count(trial.hosts.begin(), trial.hosts.end(), kNoVertex));
}

const RelaxOptions kRelax = {1000, 0.5, 0};
const double kGood = sine_squared_of_deg(35);
const double kGoal = sine_squared_of_deg(20);

TEST(ImproveOperations, KeepAllThatTheGuardsPromise) {
  for (const LabelImage& image : {touching_balls(), cavity_and_torus()}) {
    Trial trial(image);
    const std::size_t hosts = hosted(trial);
    EXPECT_GT(hosts, trial.points.size() * 9 / 10);
    const std::vector<long> chi = trial.characteristics();
    if (image.frame.size[0] == 42) {
      ASSERT_EQ(chi, (std::vector<long>{4, 0}));
    }
    std::array<std::size_t, 6> done{};
    double worst = trial.worst_sine_squared();
    for (int round = 0; round < 2; ++round) {
      const auto run = [&](std::size_t which, double floor,
                           const std::function<std::size_t(Patch&)>& operation) {
        trial.apply([&](Patch& patch) { done[which] += operation(patch); }, round);
        SCOPED_TRACE("operation " + std::to_string(which));
        expect_sound(trial, hosts);
        EXPECT_EQ(trial.characteristics(), chi);
        const double after = trial.worst_sine_squared();
        EXPECT_GE(after, std::min(worst, floor) * (1 - 1e-9));
        worst = after;
      };
      run(0, 0, [](Patch& p) { return relax_vertices(p, kRelax); });
      run(1, 1, [](Patch& p) { return remove_edges(p, kGood); });
      run(2, 0.999 * std::min(worst, kGoal), [](Patch& p) { return flatten_interfaces(p, kGoal); });
      run(3, kGoal, [](Patch& p) { return collapse_edges(p, {kGoal, 2.5, nullptr, false}); });
      run(0, 0, [](Patch& p) { return relax_vertices(p, kRelax); });
      run(4, 1, [](Patch& p) { return climb_vertices(p, kGood); });
      run(5, 1, [](Patch& p) { return collapse_edges(p, {kGood, 2.5, nullptr, true}); });
    }
    for (std::size_t which = 0; which < 5; ++which) {
      EXPECT_GT(done[which], 0U) << which;
    }
  }
}

TEST(ImproveOperations, LeaveVolumesAloneWhereTheBoundaryIsLocked) {
  Trial trial(touching_balls());
  const auto before = trial.volumes();
  const std::size_t tets = trial.mesh.tets.size();
  const std::size_t hosts = hosted(trial);
  const auto surfaces = [&] {
    return testing::surface_of_label(trial.mesh.tets, trial.mesh.materials, MaterialId{1});
  };
  const auto surface = surfaces();
  std::size_t done = 0;
  trial.apply([&](Patch& patch) {
    for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
      if (patch.on_boundary(v)) patch.mesh.lock(v);
    }
    done += relax_vertices(patch, kRelax) + remove_edges(patch, kGood) + climb_vertices(patch, kGood) +
            collapse_edges(patch, {0.05, 2.5, nullptr, false});
    EXPECT_EQ(flatten_interfaces(patch, 0), 0U);
    EXPECT_EQ(project_far_vertices(patch, kRelax), 0U);
  });
  EXPECT_GT(done, 30U);
  EXPECT_NE(trial.mesh.tets.size(), tets);
  expect_sound(trial, hosts);
  EXPECT_EQ(surfaces(), surface);
  for (std::size_t m = 1; m < before.size(); ++m) {
    EXPECT_NEAR(trial.volumes()[m], before[m], 1e-9 * before[m]);
  }
}

TEST(ImproveOperations, RemovalAndCollapseMoveNoVolumeButAtTheBoundary) {
  Trial trial(touching_balls());
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const auto before = trial.volumes();
  trial.apply([&](Patch& p) {
    remove_edges(p, kGood);
    collapse_edges(p, {kGoal, 2.5, nullptr, false});
  });
  for (std::size_t m = 1; m < before.size(); ++m) {
    // A sphere of radius 6 within the guard of .15 diagonals: less than 3 * .26 / 6 of its volume.
    EXPECT_NEAR(trial.volumes()[m], before[m], 0.13 * before[m]);
    EXPECT_NE(trial.volumes()[m], before[m]);
  }
}

TEST(ImproveOperations, CollapsesStayWithinTheLongestEdge) {
  Trial trial(touching_balls());
  const auto longest = [&] {
    double squared = 0;
    for (const auto& n : trial.mesh.tets) {
      for (std::size_t i = 0; i < 4; ++i) {
        squared =
            std::max(squared, (trial.mesh.points[n[i]] - trial.mesh.points[n[(i + 1) % 4]]).squared_norm());
      }
    }
    return std::sqrt(squared);
  };
  trial.apply([&](Patch& p) { relax_vertices(p, kRelax); });
  const double limit = 1.3 * longest();
  const std::vector<double> limits(3, limit);
  std::size_t collapsed = 0;
  trial.apply([&](Patch& p) { collapsed += collapse_edges(p, {0.05, 10, &limits, false}); });
  EXPECT_GT(collapsed, 5U);
  EXPECT_LE(longest(), limit * (1 + 1e-9));
}

TEST(ImproveOperations, CollapsesThatPlaceAnewKeepTheGuardsAndThinOutFurther) {
  for (const LabelImage& image : {touching_balls(), cavity_and_torus()}) {
    std::array<std::size_t, 2> left{};
    for (const bool optimize_position : {false, true}) {
      Trial trial(image);
      trial.apply([](Patch& p) { relax_vertices(p, kRelax); });
      trial.apply([](Patch& p) { remove_edges(p, kGood); });
      const std::size_t hosts = hosted(trial);
      const std::vector<long> chi = trial.characteristics();
      const double worst = trial.worst_sine_squared();
      CollapseOptions options{kGoal, 5, nullptr, false};
      options.optimize_position = optimize_position;
      std::size_t removed = 1;
      for (int pass = 0; removed > 0; ++pass) {
        ASSERT_LT(pass, 40);  // they end
        removed = 0;
        trial.apply([&](Patch& p) { removed += collapse_edges(p, options); });
      }
      expect_sound(trial, hosts);
      EXPECT_EQ(trial.characteristics(), chi);
      EXPECT_GE(trial.worst_sine_squared(), std::min(worst, kGoal) * (1 - 1e-9));
      left[optimize_position ? 1 : 0] = trial.mesh.tets.size();
    }
    EXPECT_LT(left[1], left[0] * 9 / 10);
  }
}

TEST(ImproveOperations, CollapsesLeaveThinPartsTheirVolume) {
  // A plate of one voxel: with the share no more than a little of it is worn away.
  const LabelImage plate = testing::make_image({24, 24, 9}, {1, 1, 1}, 1, [](const Vec3& p) {
    return std::hypot(p.x - 11.5, p.y - 11.5) < 9 && std::fabs(p.z - 4) < 0.6 ? 1 : 0;
  });
  std::array<double, 2> kept{};
  for (const bool guarded : {false, true}) {
    Trial trial(plate);
    trial.apply([](Patch& p) { relax_vertices(p, kRelax); });
    const double before = trial.volumes()[1];
    CollapseOptions options{0.02, 10, nullptr, false};
    options.optimize_position = true;
    options.volume_share = guarded ? 0 : 1;
    std::size_t removed = 0;
    trial.apply([&](Patch& p) { removed += collapse_edges(p, options); });
    EXPECT_GT(removed, 10U);
    kept[guarded ? 1 : 0] = trial.volumes()[1] / before;
  }
  EXPECT_GE(kept[1], 1 - 1e-9);
  EXPECT_LT(kept[0], kept[1]);
}

TEST(ImproveOperations, PullStraysBringsVerticesBackToTheBoundary) {
  Trial trial(touching_balls());
  const auto strays = [&](Patch& patch) {
    std::size_t count = 0;
    for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
      if (patch.mesh.locked(v) || !patch.on_boundary(v)) continue;
      patch.mesh.star(v, patch.star);
      patch.mesh.facets(v, patch.star, patch.facets);
      const bool far = std::any_of(patch.facets.begin(), patch.facets.end(), [&](const FacetAt& f) {
        return trial.boundary.sample(patch.mesh.point(v), f.inner, f.outer).deviation_mm >
               patch.guards.deviation_mm;
      });
      count += far ? 1 : 0;
    }
    return count;
  };
  trial.apply([&](Patch& patch) {
    const std::size_t before = strays(patch);
    EXPECT_GT(before, 50U);
    EXPECT_GT(project_far_vertices(patch, kRelax), 0U);
    EXPECT_LT(strays(patch), before / 10);
  });
}

TEST(MeshPatches, TheCutsAreInvisibleAndKeepTheMesh) {
  Trial trial(touching_balls());
  const auto volumes = trial.volumes();
  const std::size_t tets = trial.mesh.tets.size();
  trial.rules.patch_tets = 200;
  const std::size_t hosts = hosted(trial);
  std::atomic<std::size_t> seen = 0;
  std::atomic<int> patches = 0;
  trial.apply([&](Patch& patch) {  // nothing is done, nothing changes
    seen += patch.mesh.tet_slots();
    ++patches;
  });
  EXPECT_EQ(seen, tets);
  EXPECT_GT(patches, 4);
  EXPECT_EQ(trial.mesh.tets.size(), tets);
  expect_sound(trial, hosts);
  for (std::size_t m = 1; m < volumes.size(); ++m) {
    EXPECT_NEAR(trial.volumes()[m], volumes[m], 1e-9 * volumes[m]);
  }
  const std::vector<long> chi = trial.characteristics();
  for (int round = 0; round < 4; ++round) {
    trial.apply(
        [&](Patch& p) {
          relax_vertices(p, kRelax);
          remove_edges(p, kGood);
          flatten_interfaces(p, kGoal);
          collapse_edges(p, {kGoal, 2.5, nullptr, false});
          climb_vertices(p, kGoal);
        },
        round);
    expect_sound(trial, hosts);
    EXPECT_EQ(trial.characteristics(), chi);
  }
  EXPECT_LT(trial.mesh.tets.size(), tets * 3 / 4);
}

// ---- the stage and the preset

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
  EXPECT_TRUE(points_without_host(interface_points(image), local.points, sets, 1.1 * diagonal).empty());
}

TEST(RefineLattice, SmoothLabelsAreThoseOfTheBoundaryAtTheCentroids) {
  const LabelImage image = touching_balls();
  const ImageBoundary boundary(image, {});
  for (const bool smooth : {true, false}) {
    Lattice lattice = build_bcc_lattice(image, {3, 0.5});
    RefineOptions options;
    options.smooth_labels = smooth;
    options.one_face_rule = false;
    options.each_interface = true;
    options.max_distance_mm = image.frame.voxel_diagonal_mm();
    options.finest_spacing_mm = 1;
    const RefineResult result = refine_lattice(lattice, image, options, [](int, std::size_t) {});
    const std::vector<Vec3> points = local_points(lattice);
    const CandidateMesh& mesh = result.mesh;
    std::size_t unlike_voxel = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Vec3 centroid;
      for (const VertexId v : mesh.tets.nodes[t]) centroid += 0.25 * points[v];
      unlike_voxel += mesh.materials[t] != image.at_local(centroid) ? 1 : 0;
      ASSERT_EQ(mesh.materials[t], smooth ? boundary.material_at(centroid) : image.at_local(centroid));
    }
    EXPECT_EQ(unlike_voxel > 0, smooth);
    // The distance is held for every interface, so far as the lattice goes.
    const auto sets = vertex_materials(mesh.tets.nodes, mesh.materials, mesh.neighbours, points.size());
    EXPECT_EQ(points_without_host(interface_points(image), points, sets, options.max_distance_mm).size(),
              result.uncovered_voxels);
    EXPECT_EQ(result.uncovered_voxels, 0U);
  }
}

TEST(ImproveMesh, LeavesAGoodMeshGoodAndIsRepeatable) {
  const LabelImage image = touching_balls();
  MaterialMesh mesh = to_material_mesh(mesh_of(image), image);
  MaterialMesh again = mesh;
  ImproveOptions options;
  int rounds = 0;
  const ImproveReport report = improve_mesh(mesh, image, options, [&](int) { ++rounds; });
  improve_mesh(again, image, options, [](int) {});
  EXPECT_EQ(mesh.points, again.points);
  EXPECT_EQ(mesh.tets, again.tets);
  EXPECT_GT(rounds, 0);
  EXPECT_LE(report.tets_after, report.tets_before);
  EXPECT_GE(report.min_dihedral_after_deg, 20);
  EXPECT_EQ(report.uncovered_points, 0U);
}

}  // namespace
}  // namespace cbc3d
